/* How decisions differ between precisions: kernels decide as they compute, and prove afterwards that rounding
   did not matter (docs/mathematics.md, "Certain decisions"). */
#ifndef POWERCELL_BASE_DECIDE
#define POWERCELL_BASE_DECIDE
#include "base/real.cl"

/* SEARCH_MARGIN: planes that clear every vertex by a 16th of this part of the cell's radius need not be noted
   one by one; searches keep such a margin when they leave out seeds. LEAST_FILLING: of the cube or square of
   the radius; whole cells smaller than that are left to the host. MOST_BLUR: where errors of the data move a
   wall by more than so many times what rounding does, its cell is left to the host. QUICK_PROOF: whether the
   proof from the way is tried (cell/certain.cl); floats are not exact enough for it. */
#define QUICK_PROOF (REAL_BITS == 64)
#if REAL_BITS == 32
#define SEARCH_MARGIN ((real)1 / (real)(1 << MARGIN_BITS_FLOAT))
#define LEAST_FILLING ((real)0.05)
#define MOST_BLUR 1
#else
#define SEARCH_MARGIN ((real)1 / (real)(1 << MARGIN_BITS_DOUBLE))
#define LEAST_FILLING 0
#define MOST_BLUR (REAL_MAX / 4)
#endif

#endif
