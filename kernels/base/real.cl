/* Scalar types, seeds and the few things that differ between precisions; with decide.cl, lanes.cl, point.cl
   and neighbors/blocks.cl the only place of #if on them. Defines: REAL_BITS (32, 64), DIMENSION (of the
   space), CELL_DIMENSION (2: convex polygons, 3: convex polyhedra), VERTEX_CAPACITY, FACE_CAPACITY and
   OUTPUTS. */
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
#ifndef OUTPUTS
#define OUTPUTS 7
#endif

#pragma OPENCL FP_CONTRACT OFF

/* UNROLL goes before loops over a few coordinates. Compilers that do not unroll on their own (PoCL's) would
   keep indexed arrays in memory; others may ignore it. */
#define UNROLL _Pragma("unroll")

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

/* a - b by coordinates, and the difference of the weights (exact to the precision of the result
   also far from the origin). */
static inline real weight_difference(seed_t a, seed_t b);
static inline void difference(seed_t a, seed_t b, real* d);

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

/* By how much the differences of a seed from anything may be off beyond relative rounding: what two floats
   leave out of coordinates and weights, and products that underflow. */
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

/* What that makes of 2 q.y - |q|^2 - dw, of a plane with |q_1| + |q_2| + ... = sum and points no farther than
 * `reach`. */
static inline real plane_blur(blur_t blur, real reach, real sum) {
  return 8 * blur.position * (reach + sum) + 2 * blur.weight;
}

static inline real norm2(const real* d) {
  real s = d[0] * d[0];
  UNROLL for (int k = 1; k < DIMENSION; ++k) s += d[k] * d[k];
  return s;
}

#endif
