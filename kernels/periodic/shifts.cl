/* Which images of a seed are made. */
#ifndef POWERCELL_PERIODIC_SHIFTS
#define POWERCELL_PERIODIC_SHIFTS
#include "seeds/period.cl"

/* More than the rounding of fractions in reals. */
#define FRACTION_ROUNDING ((real)1e-5)
#define MARGIN_BITS 24

/* The shifts of the images of one seed within the margin, itself among them. */
typedef struct {
  int low[DIMENSION], high[DIMENSION];
} shift_range_t;

/* Whether a margin is as wide as the images of the Voronoi cell along vector k (34a), so that no image is
   missing there. */
static inline bool is_complete(__global const stored_real* extent, real margin, int k) {
  return margin >= extent[EXTENT_REACH + k] * extent[EXTENT_SPACING + k] * (1 + FRACTION_ROUNDING);
}

static inline shift_range_t shifts_of(const long* at, __global const long* period,
                                      __global const stored_real* extent, real margin) {
  shift_range_t range;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    range.low[k] = range.high[k] = 0;
    if (k >= period[PERIOD_COUNT]) continue;
    const real reach = extent[EXTENT_REACH + k], wanted = margin / extent[EXTENT_SPACING + k];
    const real most = fmin(wanted, reach) + FRACTION_ROUNDING;
    const long bits = period[PERIOD_BITS + k] + PERIOD_FINE, f = fraction_along(at, period, k),
               width = scaled((long)(most * (1 << MARGIN_BITS)), bits - MARGIN_BITS);
    range.low[k] = (int)-scaled(f + width, -bits); /* the least whole number from -width - f on */
    range.high[k] = (int)scaled(one_fraction(period, k) + width - f, -bits);
  }
  return range;
}

static inline uint count_shifts(shift_range_t range) {
  uint count = 1;
  UNROLL for (int k = 0; k < DIMENSION; ++k) count *= (uint)(range.high[k] - range.low[k] + 1);
  return count;
}

/* The place of a shift in tables of SHIFT_COUNT entries. */
static inline int place_of_shift(const long* shift) {
  int at = 0;
  for (int k = 0; k < 3; ++k) at = at * SHIFT_SIDE + (k < DIMENSION ? (int)shift[k] : 0) + SHIFT_MOST;
  return at;
}

#endif
