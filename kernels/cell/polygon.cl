/* A convex polygon in two or three coordinates as a ring of vertices, cut by half-spaces. Edge v goes from
   vertex v to vertex next[v] and has what lies behind it in border[v]. */
#ifndef POWERCELL_CELL_POLYGON
#define POWERCELL_CELL_POLYGON
#include "cell/certain.cl"

/* Capacity of the list of removed edges. */
#define REMOVED_CAPACITY 24

typedef struct {
  vertices_t at;
  index_t next[VERTEX_CAPACITY];
  index_t previous[VERTEX_CAPACITY];
  int border[VERTEX_CAPACITY];
  real4 line[VERTEX_CAPACITY];   /* (q, offset) of the bisector of an edge; see cell_certain */
  real doubt[VERTEX_CAPACITY];   /* for cell_certain */
  int removed[REMOVED_CAPACITY]; /* borders of removed edges */
  int removed_count;
  int corners; /* of the region */
  int first;   /* some vertex */
} cell_t;

static inline void link_vertices(cell_t* cell, int from, int to) {
  cell->next[from] = (index_t)to;
  cell->previous[to] = (index_t)from;
}

/* The region as the cell of seed `self`; of a box around the seed only what is within `extent` in each
   coordinate. Returns a PIECE status. */
static inline int cell_start(cell_t* cell, regions_t regions, __global const seed_t* seeds, uint self,
                             uint region, real extent) {
  const uint first = regions.offset[region];
  const int count = (int)(regions.offset[region + 1] - first);
  if (count > VERTEX_CAPACITY) return PIECE_FULL;
  start_vertices(&cell->at, regions, seeds, self, regions.vertex + first, regions.behind + first);
  cell->first = 0;
  cell->corners = count;
  cell->removed_count = 0;
  set_corners(&cell->at, count, extent);
  for (int v = 0; v < count; ++v) {
    cell->border[v] = ~v;
    link_vertices(cell, v, v + 1 == count ? 0 : v + 1);
  }
  return PIECE_DONE;
}

/* The plane that the cell lies in. */
static inline certain_plane_t ground_plane(const cell_t* cell) {
  if (DIMENSION == 2) {
    const certain_plane_t flat = {make_real4(0, 0, 1, 0), 0};
    return flat;
  }
  const real4 y = region_corner(&cell->at, 0);
  const real4 a = region_corner(&cell->at, 1) - y, b = region_corner(&cell->at, 2) - y;
  return facet_plane(&cell->at, y, a, b, cross3(a, b));
}

/* The line of facet `slot` of the region, as a plane of unit normal across the ground. */
static inline certain_plane_t facet_line(const cell_t* cell, int slot, real4 ground) {
  const real4 y = region_corner(&cell->at, slot);
  const real4 along = region_corner(&cell->at, slot + 1 == cell->corners ? 0 : slot + 1) - y;
  return facet_plane(&cell->at, y, along, ground, cross3(along, ground));
}

/* The line of an edge. */
static inline certain_plane_t edge_line(const cell_t* cell, int v, real4 ground) {
  return cell->border[v] < 0 ? facet_line(cell, ~cell->border[v], ground)
                             : border_plane(&cell->at, cell->border[v], cell->line[v]);
}

/* What edge f lies in: 2 q.y = offset. */
static inline void set_face_plane(cell_t* cell, int f, const real* q, real offset) {
  cell->line[f] = make_real4(q[0], q[1], DIMENSION == 3 ? q[DIMENSION - 1] : 0, offset);
}

/* Keeps what was behind the edges that have both ends outside the last cut; they are still linked. */
static inline void forget_edges(cell_t* cell, int first, int last) {
  for (int v = first; v != last; v = cell->next[v]) {
    if (cell->removed_count < REMOVED_CAPACITY) cell->removed[cell->removed_count] = cell->border[v];
    ++cell->removed_count;
  }
}

/* The first removed edge from k on whose line may come nearer than the gap; where there is none, `count`. */
static inline int next_removed(const cell_t* cell, int k, int count, removed_t* removed) {
  for (; k < count; ++k) {
    const int border = cell->removed[k];
    *removed = border < 0
                   ? removed_facet(&cell->at, facet_line(cell, ~border, ground_plane(cell).plane), border)
                   : removed_bisector(&cell->at, raw_bisector(&cell->at, border), border);
    if (may_be_gap(&cell->at, *removed)) break;
  }
  return k;
}

/* Updates the gaps for the lines of removed edges. If there were more than the list holds, nothing is
   certain. Work-items search for such an edge first, so that they look at its line together. */
static inline void note_removed_edges(cell_t* cell) {
  const int count = min(cell->removed_count, REMOVED_CAPACITY);
  removed_t removed;
  if (cell->removed_count > REMOVED_CAPACITY) cell->at.gap = -1;
  for (int k = next_removed(cell, 0, count, &removed); k < count;
       k = next_removed(cell, k + 1, count, &removed))
    note_removed(&cell->at, removed);
}

/* The ends first..last of the one run of outside vertices; false if there are several. */
static inline bool find_run(const cell_t* cell, int* first, int* last) {
  int firsts = 0, lasts = 0;
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.outside[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      const bool begins = !is_outside(&cell->at, cell->previous[v]),
                 ends = !is_outside(&cell->at, cell->next[v]);
      *first = begins ? v : *first;
      *last = ends ? v : *last;
      firsts += begins;
      lasts += ends;
    }
  return firsts == 1 && lasts == 1;
}

/* Keeps the part with 2 q.y <= offset. Vertices within the tolerance of the line are kept,
   unless nothing else is. Returns a CUT code; after CUT_TOUCH side[] holds. */
static inline int cell_cut(cell_t* cell, const real* q, real offset, real tolerance, int border) {
  if (find_sides(&cell->at, q, offset) < -tolerance) return CUT_NONE;
  int inside, vertices, first = 0, last = 0;
  const int outside = count_sides(&cell->at, tolerance, &vertices, &inside);
  if (inside == 0) return outside > 0 ? CUT_EMPTY : CUT_WITHIN;
  if (outside == 0) return vertices - inside >= CELL_DIMENSION ? CUT_TOUCH : CUT_NONE;
  if (!find_run(cell, &first, &last)) return CUT_TANGLED;
  const int before = cell->previous[first], after = cell->next[last];
  const int a = free_slot(&cell->at, VERTEX_CAPACITY);
  if (a < 0) return CUT_FULL;
  set_edge_point(&cell->at, a, before, first);
  const int b = free_slot(&cell->at, VERTEX_CAPACITY);
  if (b < 0) return CUT_FULL;
  set_edge_point(&cell->at, b, after, last);
  cell->border[a] = border;
  set_face_plane(cell, a, q, offset);
  cell->border[b] = cell->border[last];
  cell->line[b] = cell->line[last];
  link_vertices(cell, before, a);
  link_vertices(cell, a, b);
  link_vertices(cell, b, after);
  cell->first = a;
  drop_outside(&cell->at);
  forget_edges(cell, first, last);
  return CUT_SHRUNK;
}

/* Faces are numbered like slots: face v may be none. */
static inline int cell_faces(const cell_t* cell) {
  return cell->at.blocks * LANES;
}

/* Whether face f lies in the plane that side[] was computed for and that nothing is outside of. */
static inline bool cell_face_touches(const cell_t* cell, int f, real tolerance) {
  if ((cell->at.used[f / WORD_BITS] >> f % WORD_BITS & 1) == 0) return false;
  return cell->at.side[f] >= -tolerance && cell->at.side[cell->next[f]] >= -tolerance;
}

/* Where the lines of vertex v meet on the ground, and at least the error of that in w; below 0 if the lines
   are nearly dependent. */
static inline real4 certain_place(const cell_t* cell, int v, certain_plane_t ground) {
  const int u = cell->previous[v];
  const certain_plane_t in = {cell->line[u], cell->doubt[u]}, out = {cell->line[v], cell->doubt[v]};
  real4 y = vertex_point(&cell->at, v);
  if (is_centred(&cell->at) || (cell->border[u] & cell->border[v]) >= 0)
    return meeting_point(&cell->at, y, ground, in, out);
  y.w = corner_error(&cell->at); /* a corner of the region */
  return y;
}

/* Whether each edge goes inwards from the line before it: then the lines bound the intersection of their
   half-planes, and no other polygon. If so, line[v] is the place of vertex v afterwards, with its error in w:
   a line has served when the second vertex after it is placed. */
static inline bool find_places(cell_t* cell, certain_plane_t ground) {
  real4 last = make_real4(0, 0, 0, 0), before_last = last;
  int v = cell->first, placed = 0;
  do {
    const int before = cell->previous[cell->previous[v]];
    const certain_plane_t line = {cell->line[before], cell->doubt[before]};
    const real4 y = certain_place(cell, v, ground);
    if (y.w < 0 || !is_inside(&cell->at, y, y.w, line)) return false;
    if (++placed > 2) cell->line[before] = before_last;
    before_last = last;
    last = y;
    v = cell->next[v];
  } while (v != cell->first);
  v = cell->previous[v];
  cell->line[v] = last;
  cell->line[cell->previous[v]] = before_last;
  return true;
}

/* Proves the shape of the cell from its edges alone, whatever rounding did on the way to it; the vertices are
   better afterwards. Returns at least the distance of the vertices as they were from the true ones, or below
   0 if the shape is not certain: then the vertices are as they were. */
static inline real cell_certain(cell_t* cell) {
  real worst = 0;
  find_radius2(&cell->at);
  const certain_plane_t ground = ground_plane(cell);
  int v = cell->first;
  do {
    const certain_plane_t line = edge_line(cell, v, ground.plane);
    cell->line[v] = line.plane;
    cell->doubt[v] = line.doubt;
    v = cell->next[v];
  } while (v != cell->first);
  if (!find_places(cell, ground)) return -1;
  do {
    worst = fmax(worst, move_vertex(&cell->at, v, cell->line[v]));
    v = cell->next[v];
  } while (v != cell->first);
  return worst;
}

/* Adds the integrals of 1, y and |y|^2 over triangle (a, b, c) to `moments` (docs/mathematics.md (13)). */
static inline void triangle_moments(const cell_t* cell, int a, int b, int c, real* moments) {
  real u[DIMENSION], v[DIMENSION], sum2 = 0, squares = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    u[k] = cell->at.x[k][b] - cell->at.x[k][a];
    v[k] = cell->at.x[k][c] - cell->at.x[k][a];
  }
  real area = u[0] * v[1] - u[1] * v[0];
  if (DIMENSION == 3) {
    const real nx = u[1] * v[DIMENSION - 1] - u[DIMENSION - 1] * v[1];
    const real ny = u[DIMENSION - 1] * v[0] - u[0] * v[DIMENSION - 1];
    area = sqrt(area * area + nx * nx + ny * ny);
  }
  area *= (real)0.5;
  moments[0] += area;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const real p = cell->at.x[k][a], q = cell->at.x[k][b], r = cell->at.x[k][c], sum = p + q + r;
    moments[1 + k] += area * sum / 3;
    sum2 += sum * sum;
    squares += p * p + q * q + r * r;
  }
  moments[1 + DIMENSION] += area * (sum2 + squares) / 12;
}

/* Before cell_certain, with `note`. */
static inline void cell_finish(cell_t* cell, bool note) {
  if (note) note_removed_edges(cell);
}

/* Whether the cell may go on in other regions. */
static inline bool cell_goes_on(const cell_t* cell) {
  int v = cell->first;
  do {
    if (cell->border[v] < 0 && cell->at.behind[~cell->border[v]] != BEHIND_NOTHING) return true;
    v = cell->next[v];
  } while (v != cell->first);
  return false;
}

static inline void cell_moments(const cell_t* cell, bool walls, real* moments) {
  (void)walls; /* these need nothing of the moments */
  UNROLL for (int k = 0; k < 2 + DIMENSION; ++k) moments[k] = 0;
  const int first = cell->first;
  for (int v = cell->next[first], w = cell->next[v]; w != first; v = w, w = cell->next[v])
    triangle_moments(cell, first, v, w, moments);
}

/* Writes what lies behind the edges and their lengths, in order, of those that are of `faces` (a sum of
   FACES_...), unless `border` is null; returns their number. */
static inline int cell_write_walls(cell_t* cell, uint faces, __global int* border,
                                   __global stored_real* wall) {
  int count = 0, v = cell->first;
  do {
    const int next = cell->next[v];
    if (is_face_of(&cell->at, cell->border[v], faces)) {
      if (border) {
        real d[DIMENSION];
        UNROLL for (int k = 0; k < DIMENSION; ++k) d[k] = cell->at.x[k][next] - cell->at.x[k][v];
        border[count] = cell->border[v];
        wall[count] = (stored_real)sqrt(norm2(d));
      }
      ++count;
    }
    v = next;
  } while (v != cell->first);
  return count;
}

/* Writes the vertices in order; returns their number. A polygon has no links. */
static inline int cell_write_vertices(cell_t* cell, __global stored_real* vertex, __global uint* link) {
  (void)link;
  int count = 0, v = cell->first;
  do {
    UNROLL for (int k = 0; k < DIMENSION; ++k) vertex[count * DIMENSION + k] = (stored_real)cell->at.x[k][v];
    ++count;
    v = cell->next[v];
  } while (v != cell->first);
  return count;
}

#endif
