/* How decisions differ between precisions, and where the host decides otherwise than devices: with its own
   error of each vertex and, where that does not suffice, exactly (lib/clip/host_decide.hpp). Devices decide
   as they compute, and prove it afterwards. Nothing here is used before the cell is known. */
#ifndef POWERCELL_BASE_DECIDE
#define POWERCELL_BASE_DECIDE
#include "base/real.cl"

/* SEARCH_MARGIN: planes that clear every vertex by a 16th of this part of the cell's radius need not be noted
   one by one; searches keep such a margin when they leave out seeds. LEAST_FILLING: of the cube or square of
   the radius; whole cells smaller than that are left to the host. MOST_BLUR: where errors of the data move a
   wall by more than so many times what rounding does, its cell is left to the host. QUICK_PROOF: whether the
   proof from the way is tried (clip/certain.cl); floats are not exact enough for it, and the host needs none.
 */
#if REAL_BITS == 32
#define SEARCH_MARGIN ((real)1 / (real)(1 << MARGIN_BITS_FLOAT))
#define LEAST_FILLING ((real)0.05)
#define MOST_BLUR 1
#else
#define SEARCH_MARGIN ((real)1 / (real)(1 << MARGIN_BITS_DOUBLE))
#define LEAST_FILLING 0
#define MOST_BLUR (REAL_MAX / 4)
#endif

#ifdef __cplusplus
#define QUICK_PROOF 0
#define PLACE_VERTEX(cell, v) host_place(cell, v)
#define COUNT_SIDES(cell, border, tolerance, vertices, inside) host_sides(cell, border, vertices, inside)
#define SIDE_TOLERANCE(cell, sum, q2, dw) host_tolerance(cell, sum, q2, dw)
#define OUTSIDE_GAP(cell, q, level, sum, error) ((real)1)
#define WHOLE_IS_CERTAIN(cell) host_finish(cell)
#define CELL_IS_FLAT(cell, moments) host_is_flat(cell, moments)
#else
#define QUICK_PROOF (REAL_BITS == 64)
#define PLACE_VERTEX(cell, v)
#define COUNT_SIDES(cell, border, tolerance, vertices, inside) \
  count_sides(&(cell)->at, tolerance, vertices, inside)
/* A value of (3) within 16 rounding errors of its terms counts as zero while cells are cut. */
#define SIDE_TOLERANCE(cell, sum, q2, dw) \
  (16 * REAL_EPSILON * (2 * (sum) * (cell)->at.reach + (q2) + fabs(dw)))
#define OUTSIDE_GAP(cell, q, level, sum, error) outside_gap(cell, q, level, sum, error)
#define WHOLE_IS_CERTAIN(cell) whole_is_certain(cell)
#define CELL_IS_FLAT(cell, moments) cell_is_flat(cell, (moments)[0])
#endif

#endif
