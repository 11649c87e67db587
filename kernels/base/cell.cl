/* The cell type of this variant: both define cell_t and the functions cell_... on it. */
#ifndef POWERCELL_BASE_CELL
#define POWERCELL_BASE_CELL
#include "base/real.cl"
#if CELL_DIMENSION == 3
#include "clip/polyhedron.cl"
#else
#include "clip/polygon.cl"
#endif

#endif
