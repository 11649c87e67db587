/* Cutting a cell by the bisector of two seeds, in coordinates relative to the cell's seed
   (docs/mathematics.md (3): kept is 2 q.y <= |q|^2 + w_i - w_j). */
#ifndef POWERCELL_CLIP_BISECTOR
#define POWERCELL_CLIP_BISECTOR
#include "base/cell.cl"

/* A side value within TOLERANCE_FACTOR rounding errors of its terms counts as zero. */

/* Cuts the cell of `seed` by its bisector with `other`, known as `border`. Returns a CUT code. */
static inline int cut_by_seed(cell_t* cell, seed_t seed, seed_t other, int border) {
  real q[DIMENSION], sum = 0;
  difference(other, seed, q);
  for (int k = 0; k < DIMENSION; ++k) sum += fabs(q[k]);
  const real q2 = norm2(q), dw = weight_difference(seed, other);
  const real tolerance = TOLERANCE_FACTOR * REAL_EPSILON * (2 * sum * cell->reach + q2 + fabs(dw));
  return cell_cut(cell, q, q2 + dw, tolerance, border);
}

/* Largest squared distance of a vertex from the seed. */
static inline real cell_radius2(const cell_t* cell) {
  real r2 = 0;
  for (int v = 0; v < cell->vertices; ++v) {
    real s = 0;
    for (int k = 0; k < DIMENSION; ++k) s += cell->x[k][v] * cell->x[k][v];
    r2 = fmax(r2, s);
  }
  return r2;
}

/* Bounding box of the vertices, relative to the seed. */
static inline void cell_box(const cell_t* cell, real* low, real* high) {
  for (int k = 0; k < DIMENSION; ++k) {
    real l = cell->x[k][0], h = l;
    for (int v = 1; v < cell->vertices; ++v) {
      l = fmin(l, cell->x[k][v]);
      h = fmax(h, cell->x[k][v]);
    }
    low[k] = l;
    high[k] = h;
  }
}

/* The status of a piece after a cut that was not CUT_NONE or CUT_SHRUNK. */
static inline int piece_status(int cut) {
  return cut == CUT_EMPTY ? PIECE_EMPTY : cut == CUT_FULL ? PIECE_FULL : PIECE_TANGLED;
}

#endif
