/* The cell type of this variant: both define cell_t and the functions cell_... on it. What they include
   themselves is included here first: the host expands an include once, also where #if leaves it out. */
#ifndef POWERCELL_BASE_CELL
#define POWERCELL_BASE_CELL
#include "clip/certain.cl"
#include "clip/vertices.cl"
#if CELL_DIMENSION == 3
#include "clip/polyhedron.cl"
#else
#include "clip/polygon.cl"
#endif

#endif
