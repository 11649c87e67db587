/* Tests which of eight seeds or nodes may cut a cell: by its box (docs/mathematics.md (9), (10)) or, tighter
   and more expensive, by its vertices (9a). The second serves the long thin cells of seeds on a surface,
   whose boxes meet almost everything. A seed that is excluded clears the cell by SEARCH_MARGIN / 16 of its
   radius (docs/mathematics.md, "Certain decisions"). */
#ifndef POWERCELL_NEIGHBORS_EXCLUDE
#define POWERCELL_NEIGHBORS_EXCLUDE
#include "cell/bisector.cl"

/* The resolution of the data (docs/mathematics.md (82a)). Searches never exclude seeds nearer than this, so
   that they are tried and found uncertain. */
static inline real resolution_of(const vertices_t* p) {
  return 32 / SEARCH_MARGIN * p->blur.position + sqrt(REAL_LEAST);
}

/* The seeds among eight at q whose bisectors may cut the box [low, high], by its worst corner
   (docs/mathematics.md (10)). A bisector that only touches the box counts. */
static inline mask8 seeds_may_cut(const real8* q, real8 dw, real resolution, const real* low,
                                  const real* high) {
  real8 reach = ZERO8, q2 = ZERO8, sum = all_lanes(resolution);
  real extent = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    reach = reach + most8(q[k] * all_lanes(low[k]), q[k] * all_lanes(high[k]));
    q2 = q2 + q[k] * q[k];
    sum = sum + size8(q[k]);
    extent = most_of(extent, most_of(fabs(low[k]), fabs(high[k])));
  }
  const real8 size = sum * all_lanes(2 * extent) + q2 + size8(dw);
  return reach + reach + size * all_lanes(SEARCH_MARGIN / 8) > q2 + dw;
}

/* The same by the vertices: some vertex violates (3). */
static inline mask8 seeds_cut(const vertices_t* p, const real8* q, real8 dw) {
  real8 reach = all_lanes(-REAL_MAX), q2 = ZERO8, sum = all_lanes(resolution_of(p));
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    q2 = q2 + q[k] * q[k];
    sum = sum + size8(q[k]);
  }
  for (int w = 0; w < words_of(p); ++w)
    for (ulong bits = p->used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      real8 s = q[0] * all_lanes(p->x[0][v]);
      UNROLL for (int k = 1; k < DIMENSION; ++k) s = s + q[k] * all_lanes(p->x[k][v]);
      reach = most8(reach, s);
    }
  const real8 size = sum * all_lanes(2 * p->radius) + q2 + size8(dw);
  return reach + reach + size * all_lanes(SEARCH_MARGIN / 8) > q2 + dw;
}

/* The margin that a node with seeds at |q|_1 <= far must keep from a cell of radius `radius`: that of a seed,
   plus the rounding of squared lengths that add up to `squares`. */
static inline real8 node_margin(real8 far, real radius, real8 squares) {
  return far * all_lanes(SEARCH_MARGIN / 4 * radius) + squares * all_lanes(16 * REAL_EPSILON);
}

/* The nodes among eight with boxes [a, b] for which the minimum of |y-p_j|^2 - w_j - |y|^2 + w_i, over the
   cell's box and the seeds j of the node, is below 0 (docs/mathematics.md (9)). */
static inline mask8 nodes_may_cut(const real8* a, const real8* b, real8 dw, real resolution, const real* low,
                                  const real* high) {
  real8 value = dw, squares = size8(dw), far = all_lanes(resolution);
  real radius = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const real8 l = all_lanes(low[k]), h = all_lanes(high[k]);
    const real8 dl = most8(most8(a[k] - l, l - b[k]), ZERO8);
    const real8 dh = most8(most8(a[k] - h, h - b[k]), ZERO8);
    value = value + least8(dl * dl - l * l, dh * dh - h * h);
    const real8 s = size8(a[k]) + size8(b[k]) + size8(l) + size8(h);
    squares = squares + s * s;
    far = far + most8(size8(a[k]), size8(b[k]));
    radius += most_of(fabs(low[k]), fabs(high[k]));
  }
  return value < node_margin(far, radius, squares);
}

/* The same by the vertices (docs/mathematics.md (9a)). */
static inline mask8 nodes_cut(const vertices_t* p, const real8* a, const real8* b, real8 dw) {
  real8 most = all_lanes(-REAL_MAX), squares = size8(dw), far = all_lanes(resolution_of(p));
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const real8 s = size8(a[k]) + size8(b[k]) + all_lanes(2 * p->radius);
    squares = squares + s * s;
    far = far + most8(size8(a[k]), size8(b[k]));
  }
  for (int w = 0; w < words_of(p); ++w)
    for (ulong bits = p->used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      real8 s = ZERO8;
      UNROLL for (int k = 0; k < DIMENSION; ++k) {
        const real8 x = all_lanes(p->x[k][v]);
        const real8 gap = most8(most8(a[k] - x, x - b[k]), ZERO8);
        s = s + (x * x - gap * gap);
      }
      most = most8(most, s);
    }
  return dw < most + node_margin(far, p->radius, squares);
}

#endif
