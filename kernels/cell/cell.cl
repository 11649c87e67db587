/* The cell type of this variant: both define cell_t and the functions cell_... on it. What they include
   themselves is included here first: the host expands an include once, also where #if leaves it out. */
#ifndef POWERCELL_BASE_CELL
#define POWERCELL_BASE_CELL
#include "cell/certain.cl"
#include "cell/vertices.cl"
#if CELL_DIMENSION == 3
#include "cell/polyhedron.cl"
#else
#include "cell/polygon.cl"
#endif

#endif
