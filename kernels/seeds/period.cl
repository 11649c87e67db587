/* The lattice of a periodic domain in integers: the same steps as in lib/domain/period_grid.cpp, with the
   same results on every device. */
#ifndef POWERCELL_SEEDS_PERIOD
#define POWERCELL_SEEDS_PERIOD
#include "base/point.cl"

typedef struct {
  long at[DIMENSION]; /* in quanta */
  long shift[3];      /* from there to the point, in the vectors as given */
  bool far;           /* the point is too far, and the rest is not good */
} place_t;

/* x * 2^by, rounded down. */
static inline long scaled(long x, long by) {
  return by >= 0 ? (long)((ulong)x << by) : x >> -by;
}

/* Whether mantissa * 2^by >= 2^range. */
static inline bool is_beyond(ulong mantissa, long by, long range) {
  return mantissa != 0 && 64 - (long)clz(mantissa) + by > range;
}

/* mantissa * 2^by, rounded down, modulo 2^64. */
static inline ulong whole_part(ulong mantissa, long by) {
  if (by >= 64 || by <= -64) return 0;
  return by >= 0 ? mantissa << by : mantissa >> -by;
}

/* Whether mantissa * 2^by exceeds its whole part by more than a half, or by a half where `odd`. */
static inline bool is_rounded_up(ulong mantissa, long by, bool odd) {
  if (by >= 0 || by <= -64) return false;
  const ulong half_way = (ulong)1 << (-by - 1), rest = mantissa & (2 * half_way - 1);
  return rest > half_way || (rest == half_way && odd);
}

/* The coordinate of a point near the origin along vector k, times one_fraction(). */
static inline long fraction_along(const long* at, __global const long* period, int k) {
  long sum = 0;
  UNROLL for (int c = 0; c < DIMENSION; ++c) {
    if (period[PERIOD_ROUNDED + c] == 0) continue;
    const long unit = PERIOD_WORD + PERIOD_FINE - period[PERIOD_RANGE + c];
    sum += mul_hi(period[PERIOD_DUAL + 3 * k + c], scaled(at[c] - period[PERIOD_ORIGIN + c], unit));
  }
  return sum;
}

static inline long one_fraction(__global const long* period, int k) {
  return scaled(1, period[PERIOD_BITS + k] + PERIOD_FINE);
}

/* Coordinate c of the sum of `by[k]` times vector k, modulo 2^64. */
static inline long sum_of_vectors(const long* by, __global const long* period, int c) {
  ulong sum = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) sum += (ulong)by[k] * (ulong)period[PERIOD_VECTOR + 3 * k + c];
  return (long)sum;
}

/* Moves a point that the estimate has left beyond a border, and subtracts that from the shift. */
static inline void settle_in_box(long* at, __global const long* period, long* shift) {
  UNROLL for (int k = 0; k < DIMENSION; ++k) UNROLL for (int c = 0; c < DIMENSION; ++c) {
    const long size = period[PERIOD_VECTOR + 3 * k + c], low = period[PERIOD_ORIGIN + c];
    if (size == 0) continue;
    const long by = at[c] >= low + size ? -1 : at[c] < low ? 1 : 0;
    at[c] += by * size;
    shift[k] -= by;
  }
}

static inline bool comes_before(const long* a, const long* b) {
  for (int c = 0; c < DIMENSION; ++c)
    if (a[c] != b[c]) return a[c] < b[c];
  return false;
}

/* Whether a point with this coordinate along vector k may be in the part that seeds are wrapped into. */
static inline bool is_near(long fraction, __global const long* period, int k) {
  const long one = one_fraction(period, k), slack = one >> PERIOD_SLACK_BITS;
  return fraction >= -slack && fraction <= one + slack;
}

/* Of the images near the border, which rounding may have put on either side, takes the one first in the order
   of coordinates. */
static inline void settle_in_lattice(long* at, __global const long* period, long* shift) {
  long first[DIMENSION], fraction[DIMENSION], best[DIMENSION];
  bool found = false;
  int images = 1;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    first[k] = at[k];
    fraction[k] = fraction_along(at, period, k);
    best[k] = 0;
    images *= 3;
  }
  for (int image = 0; image < images; ++image) {
    long v[DIMENSION], candidate[DIMENSION];
    bool near = true;
    for (int k = DIMENSION - 1, rest = image; k >= 0; --k, rest /= 3) {
      v[k] = rest % 3 - 1;
      near = near && is_near(fraction[k] + v[k] * one_fraction(period, k), period, k);
    }
    if (!near) continue;
    UNROLL for (int c = 0; c < DIMENSION; ++c) candidate[c] = first[c] + sum_of_vectors(v, period, c);
    if (found && !comes_before(candidate, at)) continue;
    found = true;
    UNROLL for (int c = 0; c < DIMENSION; ++c) {
      at[c] = candidate[c];
      best[c] = v[c];
    }
  }
  UNROLL for (int k = 0; k < DIMENSION; ++k) shift[k] -= best[k];
}

/* The shift of a point in the vectors of the lattice, to at most one along each; false if it is too far. */
static inline bool estimate_shift(const digits_t* digits, __global const long* period, long* shift) {
  long coarse[DIMENSION];
  bool far = false;
  UNROLL for (int c = 0; c < DIMENSION; ++c) {
    coarse[c] = 0;
    if (period[PERIOD_ROUNDED + c] == 0) continue;
    const long by = digits[c].exponent - period[PERIOD_QUANTUM + c], range = period[PERIOD_RANGE + c];
    far = far || is_beyond(digits[c].mantissa, by, range);
    const long size = (long)whole_part(digits[c].mantissa, by + PERIOD_WORD - range);
    coarse[c] = (digits[c].negative ? -size : size) - scaled(period[PERIOD_ORIGIN + c], PERIOD_WORD - range);
  }
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    long sum = 0;
    UNROLL for (int c = 0; c < DIMENSION; ++c) sum += mul_hi(period[PERIOD_DUAL + 3 * k + c], coarse[c]);
    shift[k] = scaled(sum, -period[PERIOD_BITS + k]);
    far = far || shift[k] >= PERIOD_MOST || shift[k] < -PERIOD_MOST;
  }
  return !far;
}

/* Wraps a point (docs/mathematics.md (34c)). Coordinates that are not rounded become 0. */
static inline place_t wrap_point(const digits_t* digits, __global const long* period) {
  place_t place;
  long shift[DIMENSION];
  place.far = !estimate_shift(digits, period, shift);
  UNROLL for (int c = 0; c < DIMENSION; ++c) {
    const long by = digits[c].exponent - period[PERIOD_QUANTUM + c];
    /* Modulo 2^64, of which the difference is a small part. */
    const ulong size = whole_part(digits[c].mantissa, by),
                rest = (digits[c].negative ? 0 - size : size) - (ulong)sum_of_vectors(shift, period, c);
    const bool up = is_rounded_up(digits[c].mantissa, by, (rest & 1) != 0);
    place.at[c] = (long)rest + (up ? (digits[c].negative ? -1 : 1) : 0);
    if (period[PERIOD_ROUNDED + c] == 0) place.at[c] = 0;
  }
  if (period[PERIOD_IS_BOX] != 0)
    settle_in_box(place.at, period, shift);
  else
    settle_in_lattice(place.at, period, shift);
  UNROLL for (int m = 0; m < 3; ++m) {
    place.shift[m] = 0;
    UNROLL for (int k = 0; k < DIMENSION; ++k) place.shift[m] += shift[k] * period[PERIOD_GIVEN + 3 * k + m];
    place.far = place.far || place.shift[m] > 2 * PERIOD_MOST || place.shift[m] < -2 * PERIOD_MOST;
  }
  return place;
}

/* Coordinate c of a place in the frame, as high + low. */
static inline void place_to_frame(long at, __global const long* period, int c, real* high, real* low) {
  const long halves = 2 * at - period[PERIOD_CENTRE + c];
  const int exponent = (int)period[PERIOD_UNIT + c];
  const real first = (real)halves;
  *high = ldexp(first, exponent);
  *low = ldexp((real)(halves - (long)first), exponent);
}

#endif
