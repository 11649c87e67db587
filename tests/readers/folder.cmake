set(library powercell_io)  # the readers and writers of files, with the shared library
