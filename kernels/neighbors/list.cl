/* Candidates from a list of nearest lifted neighbours, nearest first, with the paper's stopping rule:
   with R^2 = max |y_v|^2 + h_i^2 over the vertices, every seed at lifted distance >= 2R from the
   query leaves the cell as it is (paper, sections 4-5; docs/mathematics.md (8)). */
#ifndef POWERCELL_NEIGHBORS_LIST
#define POWERCELL_NEIGHBORS_LIST
#include "cell/bisector.cl"

typedef struct {
  __global const seed_t* seeds;     /* by rank */
  __global const stored_real* lift; /* h of each seed */
  __global const uint* neighbor;    /* rows of `stride` ranks */
  uint stride;
  uint count; /* neighbours in each row */
  uint total; /* seeds in all */
  int twins;  /* the query was (p_i, -h_i), else (p_i, h_i) */
} lists_t;

/* Squared lifted distance of seed j from the query of seed i (docs/mathematics.md (7)). */
static inline real lifted_distance2(lists_t lists, uint i, uint j) {
  real q[DIMENSION];
  difference(lists.seeds[j], lists.seeds[i], q);
  const real hi = lists.lift[i], hj = lists.lift[j];
  const real h = lists.twins ? hi + hj : hi - hj;
  return norm2(q) + h * h;
}

/* How far a list was read. */
typedef struct {
  uint tried; /* neighbours whose bisector was tried before the stopping rule held */
  uint cuts;  /* of these, the ones that cut something off */
} list_use_t;

/* Clips the cell of rank i, started as a region, by the neighbours in its row. Returns a PIECE status. */
static inline int clip_by_list(cell_t* cell, lists_t lists, uint i, uint row, list_use_t* use) {
  const real h = lists.lift[i];
  real stop = 4 * (find_radius2(&cell->at) + h * h) * (1 + SEARCH_MARGIN);
  for (uint k = 0; k < lists.count; ++k) {
    const uint j = lists.neighbor[row * lists.stride + k];
    if (lifted_distance2(lists, i, j) >= stop) return PIECE_DONE;
    const int cut = cut_by_seed(cell, (int)j);
    ++use->tried;
    if (cut != CUT_NONE) ++use->cuts;
    if (cut == CUT_SHRUNK) stop = 4 * (find_radius2(&cell->at) + h * h) * (1 + SEARCH_MARGIN);
    if (cut > CUT_SHRUNK) return piece_status(cut);
  }
  return lists.count + 1 >= lists.total ? PIECE_DONE : PIECE_MORE;
}

#endif
