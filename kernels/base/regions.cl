/* The convex regions of the domain. The clipper starts each cell as one of them. */
#ifndef POWERCELL_BASE_REGIONS
#define POWERCELL_BASE_REGIONS
#include "base/real.cl"

typedef struct {
  __global const seed_t* corner;        /* vertices of the domain */
  __global const uint* offset;          /* per region: its first vertex */
  __global const uint* vertex;          /* corners of the regions */
  __global const int* behind;           /* per facet of each region: BEHIND_NOTHING (layout.h), or a corner */
  __global const region_shape_t* shape; /* of volume regions */
} regions_t;

#endif
