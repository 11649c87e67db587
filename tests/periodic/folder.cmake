set(library powercell_oracles)
