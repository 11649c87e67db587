/* A convex polygon in two or three coordinates as a ring of vertices, cut by half-spaces. Edge v goes from
   vertex v to vertex next[v] and has what lies behind it in border[v]. */
#ifndef POWERCELL_CLIP_POLYGON
#define POWERCELL_CLIP_POLYGON
#include "clip/vertices.cl"

typedef struct {
  vertices_t at;
  STORAGE(index_t, next, VERTEX_CAPACITY);
  STORAGE(index_t, previous, VERTEX_CAPACITY);
  STORAGE(int, border, VERTEX_CAPACITY);
  int first; /* some vertex */
  HOST_MEMBERS
} cell_t;

static inline void link_vertices(cell_t* cell, int from, int to) {
  cell->next[from] = (index_t)to;
  cell->previous[to] = (index_t)from;
}

/* The region as the cell of seed `self`. Returns a PIECE status. */
static inline int cell_start(cell_t* cell, regions_t regions, __global const seed_t* seeds, uint self,
                             uint region) {
  const uint first = regions.offset[region];
  const int count = (int)(regions.offset[region + 1] - first);
  if (count > VERTEX_CAPACITY) return PIECE_FULL;
  start_vertices(&cell->at, regions, seeds, self, regions.behind + first);
  cell->first = 0;
  for (int v = 0; v < count; ++v) {
    set_corner(&cell->at, v, regions.corner[regions.vertex[first + (uint)v]]);
    cell->border[v] = ~v;
    link_vertices(cell, v, v + 1 == count ? 0 : v + 1);
  }
  return PIECE_WHOLE;
}

/* The ends first..last of the one run of outside vertices; false if there are several. */
static inline bool find_run(const cell_t* cell, int* first, int* last) {
  int firsts = 0, lasts = 0;
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.outside[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      if (!is_outside(&cell->at, cell->previous[v])) {
        *first = v;
        ++firsts;
      }
      if (!is_outside(&cell->at, cell->next[v])) {
        *last = v;
        ++lasts;
      }
    }
  return firsts == 1 && lasts == 1;
}

/* Keeps the part with 2 q.y <= level. Vertices within the tolerance of the line are kept,
   unless nothing else is. Returns a CUT code; after CUT_TOUCH side[] holds. */
static inline int cell_cut(cell_t* cell, const real* q, real level, real tolerance, int border) {
  if (find_sides(&cell->at, q, level) < -tolerance) return CUT_NONE;
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
  cell->border[b] = cell->border[last];
  link_vertices(cell, before, a);
  link_vertices(cell, a, b);
  link_vertices(cell, b, after);
  cell->first = a;
  drop_outside(&cell->at);
  return CUT_SHRUNK;
}

/* Faces are numbered like slots: face v may be none. */
static inline int cell_faces(const cell_t* cell) { return cell->at.blocks * LANES; }

/* Whether face f lies in the plane that side[] was computed for and that nothing is outside of. */
static inline bool cell_face_touches(const cell_t* cell, int f, real tolerance) {
  if ((cell->at.used[f / WORD_BITS] >> f % WORD_BITS & 1) == 0) return false;
  return cell->at.side[f] >= -tolerance && cell->at.side[cell->next[f]] >= -tolerance;
}

/* Adds the integrals of 1, y and |y|^2 over triangle (a, b, c) to `moments` (docs/mathematics.md (13)). */
static inline void triangle_moments(const cell_t* cell, int a, int b, int c, real* moments) {
  real u[DIMENSION], v[DIMENSION], sum2 = 0, squares = 0;
  for (int k = 0; k < DIMENSION; ++k) {
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
  for (int k = 0; k < DIMENSION; ++k) {
    const real p = cell->at.x[k][a], q = cell->at.x[k][b], r = cell->at.x[k][c], sum = p + q + r;
    moments[1 + k] += area * sum / 3;
    sum2 += sum * sum;
    squares += p * p + q * q + r * r;
  }
  moments[1 + DIMENSION] += area * (sum2 + squares) / 12;
}

/* Nothing to prepare before the functions below. */
static inline void cell_finish(cell_t* cell) { (void)cell; }

static inline void cell_moments(const cell_t* cell, real* moments) {
  for (int k = 0; k < 2 + DIMENSION; ++k) moments[k] = 0;
  const int first = cell->first;
  for (int v = cell->next[first], w = cell->next[v]; w != first; v = w, w = cell->next[v])
    triangle_moments(cell, first, v, w, moments);
}

/* Writes what lies behind the edges and their lengths, in order, without geometry only of walls between cells;
   returns their number. */
static inline int cell_write_walls(cell_t* cell, __global int* border, __global stored_real* wall) {
  int count = 0, v = cell->first;
  do {
    const int next = cell->next[v];
    if ((OUTPUTS & OUTPUT_GEOMETRY) || cell->border[v] >= 0) {
      real d[DIMENSION];
      for (int k = 0; k < DIMENSION; ++k) d[k] = cell->at.x[k][next] - cell->at.x[k][v];
      border[count] = cell->border[v];
      wall[count++] = (stored_real)sqrt(norm2(d));
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
    for (int k = 0; k < DIMENSION; ++k) vertex[count * DIMENSION + k] = (stored_real)cell->at.x[k][v];
    ++count;
    v = cell->next[v];
  } while (v != cell->first);
  return count;
}

#endif
