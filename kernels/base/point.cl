/* Splits a seed_t into its parts and joins them again, alike for both precisions. */
#ifndef POWERCELL_BASE_POINT
#define POWERCELL_BASE_POINT
#include "base/real.cl"

/* x y z weight, each the sum of a high and a low part with |low| at most half an ulp of high. */
typedef struct {
  real high[4];
  real low[4];
} parts_t;

/* Weight of an inactive seed: no bisector with it reaches any cell. */
#define DEAD_WEIGHT (-REAL_MAX / 4)

#if REAL_BITS == 64
/* Of a seed, in units of the domain's size: squares of these are finite. */
#define MOST_COORDINATE 1.0e140
#define MOST_WEIGHT 1.0e280
#define LEAST_EXPONENT (-900)
#define WEIGHT_KEY_BITS 64
#define FRACTION_BITS 52 /* of a number in memory */
#define EXPONENT_FIELD 0x7ff
#define EXPONENT_BIAS 1075

static inline parts_t parts_of(seed_t p) {
  const parts_t parts = {{p.x, p.y, p.z, p.w}, {0, 0, 0, 0}};
  return parts;
}
static inline seed_t seed_of(parts_t p) {
  return (double4)(p.high[0], p.high[1], p.high[2], p.high[3]);
}
static inline ulong bits_of(real x) {
  return as_ulong(x);
}
#else
#define MOST_COORDINATE 1.0e17f
#define MOST_WEIGHT 1.0e34f
#define LEAST_EXPONENT (-90)
#define WEIGHT_KEY_BITS 32
#define FRACTION_BITS 23
#define EXPONENT_FIELD 0xff
#define EXPONENT_BIAS 150

static inline parts_t parts_of(seed_t p) {
  const parts_t parts = {{p.high.x, p.high.y, p.high.z, p.high.w}, {p.low.x, p.low.y, p.low.z, p.low.w}};
  return parts;
}
static inline seed_t seed_of(parts_t p) {
  seed_t seed;
  seed.high = (float4)(p.high[0], p.high[1], p.high[2], p.high[3]);
  seed.low = (float4)(p.low[0], p.low[1], p.low[2], p.low[3]);
  return seed;
}
static inline ulong bits_of(real x) {
  return as_uint(x);
}
#endif

/* An integer below 2^WEIGHT_KEY_BITS that grows with x; equal for 0 and -0. x must not be NaN. */
static inline ulong ordered_bits(real x) {
  const ulong sign = (ulong)1 << (WEIGHT_KEY_BITS - 1), bits = bits_of(x == 0 ? (real)0 : x);
  return (bits & sign) != 0 ? 2 * sign - 1 - bits : bits | sign;
}

/* |x| = mantissa * 2^exponent. */
typedef struct {
  ulong mantissa;
  int exponent;
  bool negative, finite;
} digits_t;

static inline digits_t digits_of(real x) {
  const ulong bits = bits_of(x), fraction = bits & (((ulong)1 << FRACTION_BITS) - 1);
  const int field = (int)(bits >> FRACTION_BITS) & EXPONENT_FIELD;
  const digits_t digits = {field > 0 ? fraction | (ulong)1 << FRACTION_BITS : fraction,
                           max(field, 1) - EXPONENT_BIAS, ((bits >> (WEIGHT_KEY_BITS - 1)) & 1) != 0,
                           field != EXPONENT_FIELD};
  return digits;
}

/* a - b as high + low, without error unless it underflows. */
static inline real exact_difference(real a, real b, real* low) {
  const real d = a - b, v = d - a;
  *low = (a - (d - v)) - (b + v);
  return d;
}

/* Restores |low| <= half an ulp of high; the sum stays the same. */
static inline void normalize_parts(real* high, real* low) {
  const real sum = *high + *low;
  *low -= sum - *high;
  *high = sum;
}

static inline bool parts_less(const parts_t* a, const parts_t* b, int k) {
  return a->high[k] < b->high[k] || (a->high[k] == b->high[k] && a->low[k] < b->low[k]);
}

static inline bool is_dead(const parts_t* p) {
  return p->high[3] <= DEAD_WEIGHT;
}

static inline bool same_position(const parts_t* a, const parts_t* b) {
  bool same = true;
  UNROLL for (int k = 0; k < DIMENSION; ++k) same =
      same && a->high[k] == b->high[k] && a->low[k] == b->low[k];
  return same;
}

/* About the middle of a box, with weight 0. */
static inline seed_t middle_of(seed_t low, seed_t high) {
  const parts_t a = parts_of(low), b = parts_of(high);
  parts_t middle = {{0, 0, 0, 0}, {0, 0, 0, 0}};
  UNROLL for (int k = 0; k < DIMENSION; ++k) middle.high[k] = a.high[k] + (b.high[k] - a.high[k]) / 2;
  return seed_of(middle);
}

#endif
