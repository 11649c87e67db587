/* Cutting a cell by the bisector of two seeds, in coordinates relative to the cell's seed
   (docs/mathematics.md (3): kept is 2 q.y <= |q|^2 + w_i - w_j). */
#ifndef POWERCELL_CELL_BISECTOR
#define POWERCELL_CELL_BISECTOR
#include "cell/cell.cl"

/* What lies behind a face with border `old` that lies in the bisector of `border` (docs/mathematics.md,
   "Walls in facets"): of two seeds the farther one; behind a facet of the region the new seed, unless
   the facet bounds the domain or, on a surface, the region behind it is on this side of the bisector. */
static inline int border_behind(const cell_t* cell, int old, const real* q, real offset, real tolerance,
                                int border) {
  real p[DIMENSION];
  const seed_t seed = cell->at.seeds[cell->at.self];
  if (old >= 0) {
    difference(cell->at.seeds[old], seed, p);
    return norm2(q) > norm2(p) ? border : old;
  }
  const int behind = cell->at.behind[~old];
  if (behind == BEHIND_NOTHING) return old;
  if (DIMENSION == CELL_DIMENSION) return border;
  difference(cell->at.corner[behind], seed, p);
  real s = -offset;
  UNROLL for (int k = 0; k < DIMENSION; ++k) s += 2 * q[k] * p[k];
  return s > tolerance || (s >= -tolerance && (uint)border < cell->at.self) ? border : old;
}

/* The gap of a cell that a bisector touches. What is behind a face may be another seed from then on, whose
   bisector is not the plane that the face was made in: the shape cannot be proved from its planes. */
#define TOUCHED_GAP ((real)-1)

/* For a cell that is empty since all of it is beyond the plane: how far, at least, or below 0 if that is not
   certain. The cell is no longer usable. */
static inline real outside_gap(cell_t* cell, const real* q, real offset, real sum, real error) {
  real normal[DIMENSION];
  if (cell->at.gap <= TOUCHED_GAP) return -1;
  UNROLL for (int k = 0; k < DIMENSION; ++k) normal[k] = -q[k];
  find_sides(&cell->at, normal, -offset); /* free slots hold 0, which may be on the other side */
  const real gap = (-most_of_used(&cell->at) - error) / (2 * sum);
  if (!(gap > 0)) return -1;
  const real moved = cell_certain(cell);
  return moved < 0 ? moved : gap - moved;
}

/* Cuts the cell by the plane 2 q.y = |q|^2 + dw. Of two seeds that share a region within their bisector, as a
   triangle can lie, the one of lower rank has it. Returns a CUT code. */
static inline int cut_by_plane(cell_t* cell, const real* q, real dw, int border) {
  real sum = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) sum += fabs(q[k]);
  const real q2 = norm2(q);
  cell->at.size2 = 4 * q2;
  /* A value of (3) within 16 rounding errors of its terms counts as zero while cells are cut. */
  const real tolerance = 16 * REAL_EPSILON * (2 * sum * cell->at.reach + q2 + fabs(dw));
  const int cut = cell_cut(cell, q, q2 + dw, tolerance, border);
  const real error = plane_error(&cell->at, sum, q2, dw);
  if (cut == CUT_NONE) note_gap(&cell->at, sum, q2 + dw, error, border);
  if (QUICK_PROOF && (cut == CUT_SHRUNK || cut == CUT_EMPTY)) note_cut(&cell->at, sum, error);
  if (cut == CUT_SHRUNK) {
    note_drift(&cell->at);
    return cut;
  }
  if (cut == CUT_EMPTY)
    cell->at.gap = quickly_certain(&cell->at) ? (real)1 : outside_gap(cell, q, q2 + dw, sum, error);
  if (cut == CUT_TOUCH || cut == CUT_WITHIN) cell->at.gap = TOUCHED_GAP;
  if (cut == CUT_WITHIN) return cell->at.self < (uint)border ? CUT_NONE : CUT_EMPTY;
  if (cut != CUT_TOUCH) return cut;
  for (int f = 0; f < cell_faces(cell); ++f)
    if (cell_face_touches(cell, f, tolerance)) {
      cell->border[f] = border_behind(cell, cell->border[f], q, q2 + dw, tolerance, border);
      if (cell->border[f] == border) set_face_plane(cell, f, q, q2 + dw); /* that of a facet was not there */
    }
  return CUT_NONE;
}

/* Cuts the cell by the bisector with `other`, whose rank is `border`. Returns a CUT code. */
static inline int cut_by_seed(cell_t* cell, int border) {
  real q[DIMENSION];
  const seed_t seed = cell->at.seeds[cell->at.self], other = cell->at.seeds[border];
  difference(other, seed, q);
  return cut_by_plane(cell, q, weight_difference(seed, other), border);
}

/* The status of a piece after a cut that was not CUT_NONE or CUT_SHRUNK. */
static inline int piece_status(int cut) {
  return cut == CUT_EMPTY ? PIECE_EMPTY : cut == CUT_FULL ? PIECE_FULL : PIECE_TANGLED;
}

#endif
