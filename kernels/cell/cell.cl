/* The cell type of this variant: polygon.cl and polyhedron.cl both define cell_t and its functions cell_...
   This file includes their own includes first, since the host expands each include once, even inside an #if
   that is false. */
#ifndef POWERCELL_CELL_CELL
#define POWERCELL_CELL_CELL
#include "cell/certain.cl"
#include "cell/vertices.cl"
#if CELL_DIMENSION == 3
#include "cell/polyhedron.cl"
#else
#include "cell/polygon.cl"
#endif

#endif
