/* Scalar and seed types, and the constants and functions that depend on the precision. Only this file,
   lanes.cl, point.cl and neighbors/blocks.cl test REAL_BITS. The host defines REAL_BITS (32, 64), DIMENSION
   (of the space), CELL_DIMENSION (2: convex polygons, 3: convex polyhedra), VERTEX_CAPACITY, FACE_CAPACITY
   and LANE_WIDTH (lanes.cl). */
#ifndef POWERCELL_BASE_REAL
#define POWERCELL_BASE_REAL
#include "layout.h"

#ifndef REAL_BITS
#define REAL_BITS 32
#endif
#ifndef DIMENSION
#define DIMENSION 3
#endif
#ifndef CELL_DIMENSION
#define CELL_DIMENSION 3
#endif
/* Whether pieces have moments of a density too: defined by a file of kernels (diagram/clip_density.cl). */
#ifndef WITH_DENSITY
#define WITH_DENSITY 0
#endif

#pragma OPENCL FP_CONTRACT OFF

/* UNROLL goes before loops over a few coordinates. Compilers that do not unroll on their own (PoCL's) would
   keep indexed arrays in memory; others may ignore it. */
#define UNROLL _Pragma("unroll")

#ifndef LANE_WIDTH
#define LANE_WIDTH 8
#endif
#ifndef VERTEX_CAPACITY
#define VERTEX_CAPACITY 64
#endif
#ifndef FACE_CAPACITY
#define FACE_CAPACITY 48
#endif
#if VERTEX_CAPACITY > 255
typedef ushort index_t;
#else
typedef uchar index_t;
#endif
#define VERTEX_WORDS ((VERTEX_CAPACITY + 63) / 64) /* of a bit per vertex */

#if REAL_BITS == 64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
typedef double4 seed_t; /* x y z weight */
#define REAL_EPSILON 2.2204460492503131e-16
#define REAL_MAX 1.0e300
#define REAL_LEAST 1.0e-290 /* products below it are far from relative rounding */
#else
typedef float real;
typedef struct {
  float4 high;
  float4 low;
} seed_t; /* x y z weight, each as the sum of two floats */
#define REAL_EPSILON 1.1920929e-7f
#define REAL_MAX 1.0e38f
#define REAL_LEAST 1.0e-30f
#endif
typedef real stored_real;

/* Bounds of the proofs (docs/mathematics.md, "Certain decisions"), in which m is SEARCH_MARGIN. A search may
   leave out a seed whose bisector clears every vertex by m / 16 of the radius of the cell. A cell goes to the
   host if errors of the data move a wall more than MOST_BLUR times as far as rounding does. If its measure is
   below LEAST_FILLING of the square or cube of its radius and it goes on in no other region, it is measured
   about a centre, and goes to the host below LEAST_CENTRED_FILLING. QUICK_PROOF: whether (84) is tried, for
   which floats are not exact enough. START_NEAR: whether cells start near their seeds, (82b). */
#define QUICK_PROOF (REAL_BITS == 64)
#define START_NEAR (REAL_BITS == 32 && CELL_DIMENSION == DIMENSION)
#if REAL_BITS == 32
#define SEARCH_MARGIN ((real)1 / (real)(1 << MARGIN_BITS_FLOAT))
#define LEAST_FILLING ((real)0.1)
#define LEAST_CENTRED_FILLING ((real)0.005)
#define MOST_BLUR 1
#define NEGLIGIBLE_WALL NEGLIGIBLE_WALL_FLOAT
#define LARGEST_DENSITY LARGEST_DENSITY_FLOAT
#else
#define SEARCH_MARGIN ((real)1 / (real)(1 << MARGIN_BITS_DOUBLE))
#define LEAST_FILLING 0
#define LEAST_CENTRED_FILLING 0
#define MOST_BLUR (REAL_MAX / 4)
#define NEGLIGIBLE_WALL NEGLIGIBLE_WALL_DOUBLE
#define LARGEST_DENSITY LARGEST_DENSITY_DOUBLE
#endif

/* The difference of two weights, and d = a - b by coordinates. Far from the origin too, both are exact to the
   precision of the result. */
#if REAL_BITS == 32
static inline real weight_difference(seed_t a, seed_t b) {
  return (a.high.w - b.high.w) + (a.low.w - b.low.w);
}
static inline void difference(seed_t a, seed_t b, real* d) {
  const float4 c = (a.high - b.high) + (a.low - b.low);
  d[0] = c.x;
  d[1] = c.y;
  if (DIMENSION == 3) d[DIMENSION - 1] = c.z;
}
#else
static inline real weight_difference(seed_t a, seed_t b) {
  return (real)a.w - (real)b.w;
}
static inline void difference(seed_t a, seed_t b, real* d) {
  d[0] = (real)a.x - (real)b.x;
  d[1] = (real)a.y - (real)b.y;
  if (DIMENSION == 3) d[DIMENSION - 1] = (real)a.z - (real)b.z;
}
#endif

/* Bounds b and b_w (docs/mathematics.md (82a)) for the errors of differences from a seed beyond relative
   rounding: the parts of coordinates and weights that two floats cannot hold, and products that underflow. */
typedef struct {
  real position, weight;
} blur_t;

#if REAL_BITS == 32
static inline blur_t blur_of(seed_t p) {
  const real square = REAL_EPSILON * REAL_EPSILON;
  const blur_t blur = {(fabs(p.high.x) + fabs(p.high.y) + fabs(p.high.z) + 1) * square,
                       fabs(p.high.w) * square + REAL_LEAST};
  return blur;
}
#else
static inline blur_t blur_of(seed_t p) {
  const blur_t blur = {0, REAL_LEAST};
  (void)p;
  return blur;
}
#endif

/* The error (82a) of 2 q.y - |q|^2 - dw due to `blur`, where |q_1| + |q_2| + ... = sum and |y| <= reach. */
static inline real plane_blur(blur_t blur, real reach, real sum) {
  return 8 * blur.position * (reach + sum) + 2 * blur.weight;
}

static inline real norm2(const real* d) {
  real s = d[0] * d[0];
  UNROLL for (int k = 1; k < DIMENSION; ++k) s += d[k] * d[k];
  return s;
}

#endif
