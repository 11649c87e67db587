set(library powercell_commands)  # the tool's benchmark, with the shared library
