/* Tests which seeds or nodes may cut a cell: by its box (docs/mathematics.md (9), (10)) or, tighter
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

/* The seeds at q whose bisectors may cut the box of the cell, by its worst corner
   (docs/mathematics.md (10)). A bisector that only touches the box counts. */
static inline mask seeds_may_cut(const vertices_t* p, const reals* q, reals dw) {
  reals reach = ZERO, q2 = ZERO, sum = all_lanes(resolution_of(p));
  real extent = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    reach = reach + each_most(q[k] * all_lanes(p->low[k]), q[k] * all_lanes(p->high[k]));
    q2 = q2 + q[k] * q[k];
    sum = sum + each_size(q[k]);
    extent = most_of(extent, most_of(fabs(p->low[k]), fabs(p->high[k])));
  }
  const reals size = sum * all_lanes(2 * extent) + q2 + each_size(dw);
  return reach + reach + size * all_lanes(SEARCH_MARGIN / 8) > q2 + dw;
}

/* The same by the vertices: some vertex violates (3). */
static inline mask seeds_cut(const vertices_t* p, const reals* q, reals dw) {
  reals reach = all_lanes(-REAL_MAX), q2 = ZERO, sum = all_lanes(resolution_of(p));
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    q2 = q2 + q[k] * q[k];
    sum = sum + each_size(q[k]);
  }
  for (int w = 0; w < words_of(p); ++w)
    for (ulong bits = p->used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      reals s = q[0] * all_lanes(p->x[0][v]);
      UNROLL for (int k = 1; k < DIMENSION; ++k) s = s + q[k] * all_lanes(p->x[k][v]);
      reach = each_most(reach, s);
    }
  const reals size = sum * all_lanes(2 * p->radius) + q2 + each_size(dw);
  return reach + reach + size * all_lanes(SEARCH_MARGIN / 8) > q2 + dw;
}

/* The margin that a node with seeds at |q|_1 <= far must keep from a cell of radius `radius`: that of a seed,
   plus the rounding of squared lengths that add up to `squares`. */
static inline reals node_margin(reals far, real radius, reals squares) {
  return far * all_lanes(SEARCH_MARGIN / 4 * radius) + squares * all_lanes(16 * REAL_EPSILON);
}

/* The nodes with boxes [a, b] for which the minimum of |y-p_j|^2 - w_j - |y|^2 + w_i, over the
   cell's box and the seeds j of the node, is below 0 (docs/mathematics.md (9)). */
static inline mask nodes_may_cut(const vertices_t* p, const reals* a, const reals* b, reals dw) {
  reals value = dw, squares = each_size(dw), far = all_lanes(resolution_of(p));
  real radius = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const reals l = all_lanes(p->low[k]), h = all_lanes(p->high[k]);
    const reals dl = each_most(each_most(a[k] - l, l - b[k]), ZERO);
    const reals dh = each_most(each_most(a[k] - h, h - b[k]), ZERO);
    value = value + each_least(dl * dl - l * l, dh * dh - h * h);
    const reals s = each_size(a[k]) + each_size(b[k]) + each_size(l) + each_size(h);
    squares = squares + s * s;
    far = far + each_most(each_size(a[k]), each_size(b[k]));
    radius += most_of(fabs(p->low[k]), fabs(p->high[k]));
  }
  return value < node_margin(far, radius, squares);
}

/* The same by the vertices (docs/mathematics.md (9a)). */
static inline mask nodes_cut(const vertices_t* p, const reals* a, const reals* b, reals dw) {
  reals most = all_lanes(-REAL_MAX), squares = each_size(dw), far = all_lanes(resolution_of(p));
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const reals s = each_size(a[k]) + each_size(b[k]) + all_lanes(2 * p->radius);
    squares = squares + s * s;
    far = far + each_most(each_size(a[k]), each_size(b[k]));
  }
  for (int w = 0; w < words_of(p); ++w)
    for (ulong bits = p->used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      reals s = ZERO;
      UNROLL for (int k = 0; k < DIMENSION; ++k) {
        const reals x = all_lanes(p->x[k][v]);
        const reals gap = each_most(each_most(a[k] - x, x - b[k]), ZERO);
        s = s + (x * x - gap * gap);
      }
      most = each_most(most, s);
    }
  return dw < most + node_margin(far, p->radius, squares);
}

#endif
