/* Operations on LANE_WIDTH numbers at once, of the eight seeds of a leaf, the eight children of a node or the
   vertices of a cell. Like real.cl it hides the precision behind names.

   A CPU takes all eight of a leaf at once (LANE_WIDTH 8), in the registers of its vector units. On a GPU each
   work-item is a lane itself, and numbers of eight lanes take eight registers of each: there, four are taken
   at once (LANE_WIDTH 4), since a work-item that waits for one number at a time waits too often, or one
   (LANE_WIDTH 1). Results have the same bits. */
#ifndef POWERCELL_BASE_LANES
#define POWERCELL_BASE_LANES
#include "base/real.cl"

#define LANES 8 /* seeds of a leaf, children of a node; slots of vertices come in as many */

#if REAL_BITS == 64
typedef double4 real4;
typedef long4 mask4;
#define AS_INDEX as_ulong
#define AS_REAL as_double
typedef ulong lane_bits_t;
#else
typedef float4 real4;
typedef int4 mask4;
#define AS_INDEX as_uint
#define AS_REAL as_float
typedef uint lane_bits_t;
#endif

static inline real4 make_real4(real x, real y, real z, real w) {
  return (real4)(x, y, z, w);
}

/* Minimum and maximum without a branch; b where a is NaN. */
static inline real least_of(real a, real b) {
  return a < b ? a : b;
}
static inline real most_of(real a, real b) {
  return a > b ? a : b;
}

/* Puts a small index into the lowest bits of numbers, so that the least of many carries its own index. */
#define TAG_BITS 9
#define TAG_MASK ((lane_bits_t)((1 << TAG_BITS) - 1))
static inline uint tag_of(real a) {
  return (uint)(AS_INDEX(a) & TAG_MASK);
}
static inline real untagged(real a) {
  return AS_REAL(AS_INDEX(a) & ~TAG_MASK);
}

/* Below, `reals` are LANE_WIDTH numbers. choose() takes b in each lane where `yes` holds, else a. each_least
   and each_most need not treat NaN as fmin and fmax do: no lane is ever NaN. lane_bits() has bit k set where
   lane k is true, and lanes_of() is its inverse. with_lane() replaces a lane, none if there is none of that
   number. tag() gives the first lane the index `first`, and so on. */
#if LANE_WIDTH == 1
typedef real reals;
typedef int mask;

/* Before a loop over LANES: unrolled, it would take the registers that lanes one by one are to save. */
#define ONE_BY_ONE _Pragma("unroll 1")

static inline reals all_lanes(real x) {
  return x;
}
static inline reals choose(reals a, reals b, mask yes) {
  return yes ? b : a;
}
static inline reals each_least(reals a, reals b) {
  return b < a ? b : a;
}
static inline reals each_most(reals a, reals b) {
  return a < b ? b : a;
}
static inline reals each_size(reals a) {
  return fabs(a);
}
static inline real lane_most(reals a) {
  return a;
}
static inline real lane_least(reals a) {
  return a;
}
static inline uint lane_bits(mask yes) {
  return yes ? 1 : 0;
}
static inline mask lanes_of(uint bits) {
  return (mask)(bits & 1);
}
static inline reals with_lane(reals a, uint lane, real x) {
  return lane == 0 ? x : a;
}
static inline reals load_lanes(const real* at) {
  return *at;
}
static inline reals load_stored_lanes(__global const stored_real* at) {
  return *at;
}
static inline void store_lanes(reals a, real* at) {
  *at = a;
}
static inline reals tag(reals a, uint first) {
  return AS_REAL((AS_INDEX(a) & ~TAG_MASK) | (lane_bits_t)first);
}
#else
#define JOINED(name, width) name##width
#define OF_WIDTH(name, width) JOINED(name, width)
#define WIDE(name) OF_WIDTH(name, LANE_WIDTH)
#if REAL_BITS == 64
typedef WIDE(double) reals;
typedef double2 real2;
typedef WIDE(long) mask;
typedef WIDE(ulong) indices;
typedef long mask_lane_t;
#define AS_INDICES WIDE(as_ulong)
#define AS_REALS WIDE(as_double)
#else
typedef WIDE(float) reals;
typedef float2 real2;
typedef WIDE(int) mask;
typedef WIDE(uint) indices;
typedef int mask_lane_t;
#define AS_INDICES WIDE(as_uint)
#define AS_REALS WIDE(as_float)
#endif
#if LANE_WIDTH == 8
#define LANE_NUMBERS ((indices)(0, 1, 2, 3, 4, 5, 6, 7))
#define LANE_SHIFTS ((mask)(0, 1, 2, 3, 4, 5, 6, 7))
#define LANE_POWERS ((int8)(1, 2, 4, 8, 16, 32, 64, 128))
#else
#define LANE_NUMBERS ((indices)(0, 1, 2, 3))
#define LANE_SHIFTS ((mask)(0, 1, 2, 3))
#define LANE_POWERS ((int4)(1, 2, 4, 8))
#endif
#define ONE_BY_ONE

static inline reals all_lanes(real x) {
  return (reals)(x);
}
static inline reals choose(reals a, reals b, mask yes) {
  return select(a, b, yes);
}
static inline reals each_least(reals a, reals b) {
  return select(a, b, b < a);
}
static inline reals each_most(reals a, reals b) {
  return select(a, b, a < b);
}
static inline reals each_size(reals a) {
  return fabs(a);
}
static inline real lane_most(reals a) {
#if LANE_WIDTH == 8
  const real4 b = select(a.lo, a.hi, a.lo < a.hi);
#else
  const real4 b = a;
#endif
  const real2 c = select(b.lo, b.hi, b.lo < b.hi);
  return c.x < c.y ? c.y : c.x;
}
static inline real lane_least(reals a) {
#if LANE_WIDTH == 8
  const real4 b = select(a.lo, a.hi, a.hi < a.lo);
#else
  const real4 b = a;
#endif
  const real2 c = select(b.lo, b.hi, b.hi < b.lo);
  return c.y < c.x ? c.y : c.x;
}
static inline uint lane_bits(mask yes) {
  const WIDE(int) bits = WIDE(convert_int)(yes) & LANE_POWERS;
#if LANE_WIDTH == 8
  const int4 b = bits.lo | bits.hi;
#else
  const int4 b = bits;
#endif
  const int2 c = b.lo | b.hi;
  return (uint)(c.x | c.y);
}
static inline mask lanes_of(uint bits) {
  return (((mask)((mask_lane_t)bits) >> LANE_SHIFTS) & (mask)(1)) != (mask)(0);
}
static inline reals with_lane(reals a, uint lane, real x) {
  return select(a, (reals)(x), LANE_NUMBERS == (indices)((lane_bits_t)lane));
}
#if LANE_WIDTH == 8
static inline reals load_lanes(const real* at) {
  return vload8(0, at);
}
static inline reals load_stored_lanes(__global const stored_real* at) {
  return vload8(0, at);
}
typedef struct __attribute__((packed, aligned(REAL_BITS / 8))) {
  reals lanes;
} loose_lanes_t;
static inline void store_lanes(reals a, real* at) {
  ((loose_lanes_t*)at)->lanes = a;
}
#else
/* Aligned, since GPUs load what is not number by number. */
static inline reals load_lanes(const real* at) {
  return *(const reals*)at;
}
static inline reals load_stored_lanes(__global const stored_real* at) {
  return *(__global const reals*)at;
}
static inline void store_lanes(reals a, real* at) {
  *(reals*)at = a;
}
#endif
static inline reals tag(reals a, uint first) {
  return AS_REALS((AS_INDICES(a) & (indices)(~TAG_MASK)) | ((indices)((lane_bits_t)first) + LANE_NUMBERS));
}
#endif
#define ZERO ((reals)(0))
/* Of arrays that lanes are loaded from and stored to, at multiples of LANE_WIDTH. */
#if LANE_WIDTH == 4
#define FOR_LANES __attribute__((aligned(LANE_WIDTH * REAL_BITS / 8)))
#else
#define FOR_LANES
#endif
/* Over the lanes of a block, in steps of LANE_WIDTH. */
#define EACH_LANE(lane) ONE_BY_ONE for (uint lane = 0; lane < LANES; lane += LANE_WIDTH)

/* The sum of eight, in the same order for every width. */
static inline real sum_of_lanes(const real* a) {
  return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

typedef struct __attribute__((packed, aligned(REAL_BITS / 8))) {
  real4 lanes;
} loose4_t;
static inline void store4(real4 a, real* at) {
  ((loose4_t*)at)->lanes = a;
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
