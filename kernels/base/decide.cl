/* Where the host decides otherwise than devices: with its own error of each vertex and, where that does not suffice,
   exactly (lib/clip/host_decide.hpp). Devices decide as they compute, and prove it afterwards. */
#ifndef POWERCELL_BASE_DECIDE
#define POWERCELL_BASE_DECIDE
#include "base/cell.cl"

#ifdef __cplusplus
#define SIDE_TOLERANCE(cell, sum, q2, dw) host_tolerance(cell, sum, q2, dw)
#define OUTSIDE_GAP(cell, q, level, sum, error) ((real)1)
#define WHOLE_IS_CERTAIN(cell) host_finish(cell)
#define CELL_IS_FLAT(cell, moments) host_is_flat(cell, moments)
#else
/* A value of (3) within this many rounding errors of its terms counts as zero while cells are cut. */
#define TOLERANCE_FACTOR 16
#define SIDE_TOLERANCE(cell, sum, q2, dw) \
  (TOLERANCE_FACTOR * REAL_EPSILON * (2 * (sum) * (cell)->at.reach + (q2) + fabs(dw)))
#define OUTSIDE_GAP(cell, q, level, sum, error) outside_gap(cell, q, level, sum, error)
#define WHOLE_IS_CERTAIN(cell) whole_is_certain(cell)
#define CELL_IS_FLAT(cell, moments) cell_is_flat(cell, (moments)[0])
#endif

#endif
