/* Operations on eight numbers at once: the eight seeds of a leaf, the eight children of a node or eight
   vertices of a cell. Like real.cl it hides the precision behind names. */
#ifndef POWERCELL_BASE_LANES
#define POWERCELL_BASE_LANES
#include "base/real.cl"

#define LANES 8

#if REAL_BITS == 64
typedef double8 real8;
typedef double4 real4;
typedef double2 real2;
typedef long8 mask8;
typedef long4 mask4;
typedef ulong8 index8;
#define AS_INDEX8 as_ulong8
#define AS_REAL8 as_double8
#define AS_INDEX as_ulong
#define AS_REAL as_double
typedef ulong lane_bits_t;
#else
typedef float8 real8;
typedef float4 real4;
typedef float2 real2;
typedef int8 mask8;
typedef int4 mask4;
typedef uint8 index8;
#define AS_INDEX8 as_uint8
#define AS_REAL8 as_float8
#define AS_INDEX as_uint
#define AS_REAL as_float
typedef uint lane_bits_t;
#endif

static inline real4 make_real4(real x, real y, real z, real w) {
  return (real4)(x, y, z, w);
}

#define ZERO8 ((real8)(0))
#define LANE_NUMBERS ((index8)(0, 1, 2, 3, 4, 5, 6, 7))

static inline real8 all_lanes(real x) {
  return (real8)(x);
}
/* In each lane b where `yes` holds, else a. The functions below need not treat NaN as fmin and fmax do: no
   lane is ever NaN. */
static inline real8 choose8(real8 a, real8 b, mask8 yes) {
  return select(a, b, yes);
}
static inline real8 least8(real8 a, real8 b) {
  return select(a, b, b < a);
}
static inline real8 most8(real8 a, real8 b) {
  return select(a, b, a < b);
}
static inline real8 size8(real8 a) {
  return fabs(a);
}

/* Minimum and maximum without a branch; b where a is NaN. */
static inline real least_of(real a, real b) {
  return a < b ? a : b;
}
static inline real most_of(real a, real b) {
  return a > b ? a : b;
}

static inline real lane_most(real8 a) {
  const real4 b = select(a.lo, a.hi, a.lo < a.hi);
  const real2 c = select(b.lo, b.hi, b.lo < b.hi);
  return c.x < c.y ? c.y : c.x;
}
static inline real lane_least(real8 a) {
  const real4 b = select(a.lo, a.hi, a.hi < a.lo);
  const real2 c = select(b.lo, b.hi, b.hi < b.lo);
  return c.y < c.x ? c.y : c.x;
}
static inline real lane_sum(real8 a) {
  const real4 b = a.lo + a.hi;
  const real2 c = b.lo + b.hi;
  return c.x + c.y;
}
/* Bit k is set where lane k is true. */
static inline uint lane_bits(mask8 yes) {
  const int8 bits = convert_int8(yes) & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  const int4 b = bits.lo | bits.hi;
  const int2 c = b.lo | b.hi;
  return (uint)(c.x | c.y);
}
/* The mask with the lanes whose bits are set. */
static inline mask8 lanes_of(uint bits) {
#if REAL_BITS == 64
  return (((long8)((long)bits) >> (long8)(0, 1, 2, 3, 4, 5, 6, 7)) & (long8)(1)) != (long8)(0);
#else
  return (((int8)((int)bits) >> (int8)(0, 1, 2, 3, 4, 5, 6, 7)) & (int8)(1)) != (int8)(0);
#endif
}
static inline real8 with_lane(real8 a, uint lane, real x) {
  return select(a, (real8)(x), LANE_NUMBERS == (index8)((lane_bits_t)lane));
}

static inline real8 load8(const real* at) {
  return vload8(0, at);
}
static inline real8 load8_stored(__global const stored_real* at) {
  return vload8(0, at);
}
typedef struct __attribute__((packed, aligned(REAL_BITS / 8))) {
  real8 lanes;
} loose8_t;
static inline void store8(real8 a, real* at) {
  ((loose8_t*)at)->lanes = a;
}
typedef struct __attribute__((packed, aligned(REAL_BITS / 8))) {
  real4 lanes;
} loose4_t;
static inline void store4(real4 a, real* at) {
  ((loose4_t*)at)->lanes = a;
}

/* Puts a small index into the lowest bits of numbers, so that the least of many carries its own index. */
#define TAG_BITS 9
#define TAG_MASK ((lane_bits_t)((1 << TAG_BITS) - 1))
static inline real8 tag8(real8 a, uint first) {
  return AS_REAL8((AS_INDEX8(a) & (index8)(~TAG_MASK)) | ((index8)((lane_bits_t)first) + LANE_NUMBERS));
}
static inline uint tag_of(real a) {
  return (uint)(AS_INDEX(a) & TAG_MASK);
}
static inline real untagged(real a) {
  return AS_REAL(AS_INDEX(a) & ~TAG_MASK);
}

/* Dot and cross products of x, y, z. OpenCL does not define how its own dot and cross round, and that may
   even depend on the place of a work-item in its launch; proofs count roundings, and results must have the
   same bits in every launch. */
static inline real dot3(real4 a, real4 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline real4 cross3(real4 a, real4 b) {
  return make_real4(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x, 0);
}

/* Index of the lowest set bit. */
static inline int lowest_bit(ulong bits) {
  return 63 - (int)clz(bits & (~bits + 1));
}

#endif
