/* A convex polygon in two or three coordinates, cut by half-spaces. Coordinates are relative to the
   seed. Edge k goes from vertex k to vertex k+1 and has what lies behind it in border[k]. */
#ifndef POWERCELL_CLIP_POLYGON
#define POWERCELL_CLIP_POLYGON
#include "base/regions.cl"

typedef struct {
  STORAGE_ROWS(real, x, DIMENSION, VERTEX_CAPACITY);
  STORAGE(int, border, VERTEX_CAPACITY);
  STORAGE(real, side, VERTEX_CAPACITY);
  int vertices;
  real reach; /* largest coordinate sum of the region's corners: the scale of rounding errors */
  uint self;                      /* rank of the seed */
  __global const seed_t* seeds;   /* all seeds, by rank */
  __global const seed_t* corner;  /* vertices of the domain */
  __global const int* behind;     /* what lies behind the facets of the region */
  HOST_MEMBERS
} cell_t;

/* The region as the cell of seed `self`. Returns a PIECE status. */
static inline int cell_start(cell_t* cell, regions_t regions, __global const seed_t* seeds, uint self,
                             uint region) {
  const uint first = regions.offset[region];
  const int count = (int)(regions.offset[region + 1] - first);
  if (count > VERTEX_CAPACITY) return PIECE_FULL;
  cell->vertices = count;
  cell->reach = 0;
  cell->self = self;
  cell->seeds = seeds;
  cell->corner = regions.corner;
  cell->behind = regions.behind + first;
  const seed_t seed = seeds[self];
  for (int v = 0; v < count; ++v) {
    real y[DIMENSION];
    difference(regions.corner[regions.vertex[first + (uint)v]], seed, y);
    real sum = 0;
    for (int k = 0; k < DIMENSION; ++k) {
      cell->x[k][v] = y[k];
      sum += fabs(y[k]);
    }
    cell->reach = fmax(cell->reach, sum);
    cell->border[v] = ~v;
  }
  return PIECE_WHOLE;
}

static inline void cell_copy(cell_t* cell, int to, int from) {
  for (int k = 0; k < DIMENSION; ++k) cell->x[k][to] = cell->x[k][from];
  cell->border[to] = cell->border[from];
}

/* The point of the edge from vertex `in` (kept) to vertex `out` on the cutting plane. */
static inline void edge_point(const cell_t* cell, int in, int out, real* p) {
  const real t = fmax((real)0, cell->side[in] / (cell->side[in] - cell->side[out]));
  for (int k = 0; k < DIMENSION; ++k)
    p[k] = cell->x[k][in] + t * (cell->x[k][out] - cell->x[k][in]);
}

static inline void set_vertex(cell_t* cell, int v, const real* p, int border) {
  for (int k = 0; k < DIMENSION; ++k) cell->x[k][v] = p[k];
  cell->border[v] = border;
}

/* side[v] = 2 q.y_v - level for all vertices; returns how many exceed the tolerance,
   and in `inside` how many are below its negative. */
static inline int cell_sides(cell_t* cell, const real* q, real level, real tolerance, int* inside) {
  int outside = 0, below = 0;
  for (int v = 0; v < cell->vertices; ++v) {
    real s = q[0] * cell->x[0][v];
    for (int k = 1; k < DIMENSION; ++k) s += q[k] * cell->x[k][v];
    s = 2 * s - level;
    cell->side[v] = s;
    outside += s > tolerance;
    below += s < -tolerance;
  }
  *inside = below;
  return outside;
}

/* Replaces the outside run first..last (cyclic) by the two points of the cutting line. */
static inline void replace_run(cell_t* cell, int first, int last, int border) {
  const int n = cell->vertices;
  const int behind = cell->border[last];
  real a[DIMENSION], b[DIMENSION];
  edge_point(cell, first == 0 ? n - 1 : first - 1, first, a);
  edge_point(cell, last == n - 1 ? 0 : last + 1, last, b);
  int at = first;
  if (first > last) { /* the run wraps: kept vertices move to the front */
    for (int v = last + 1; v < first; ++v) cell_copy(cell, v - last - 1, v);
    at = first - last - 1;
    cell->vertices = at + 2;
  } else if (first == last) {
    for (int v = n - 1; v > last; --v) cell_copy(cell, v + 1, v);
    cell->vertices = n + 1;
  } else {
    const int shift = last - first - 1;
    if (shift > 0)
      for (int v = last + 1; v < n; ++v) cell_copy(cell, v - shift, v);
    cell->vertices = n - shift;
  }
  set_vertex(cell, at, a, border);
  set_vertex(cell, at + 1, b, behind);
}

/* Keeps the part with 2 q.y <= level. Vertices within the tolerance of the line are kept,
   unless nothing else is. Returns a CUT code; after CUT_TOUCH side[] holds. */
static inline int cell_cut(cell_t* cell, const real* q, real level, real tolerance, int border) {
  int inside;
  const int outside = cell_sides(cell, q, level, tolerance, &inside);
  const int n = cell->vertices;
  if (inside == 0) return outside > 0 ? CUT_EMPTY : CUT_WITHIN;
  if (outside == 0) return n - inside >= CELL_DIMENSION ? CUT_TOUCH : CUT_NONE;
  if (n + 1 > VERTEX_CAPACITY) return CUT_FULL;
  int first = -1, runs = 0;
  for (int v = 0; v < n; ++v) {
    const int before = v == 0 ? n - 1 : v - 1;
    if (cell->side[v] > tolerance && !(cell->side[before] > tolerance)) {
      first = v;
      ++runs;
    }
  }
  if (runs != 1) return CUT_TANGLED;
  const int last = first + outside - 1;
  replace_run(cell, first, last < n ? last : last - n, border);
  return CUT_SHRUNK;
}

/* Whether face f lies in the plane that side[] was computed for and that nothing is outside of. */
static inline bool cell_face_touches(const cell_t* cell, int f, real tolerance) {
  const int next = f + 1 == cell->vertices ? 0 : f + 1;
  return cell->side[f] >= -tolerance && cell->side[next] >= -tolerance;
}

static inline int cell_faces(const cell_t* cell) { return cell->vertices; }

/* Adds the integrals of 1, y and |y|^2 over triangle (0, b, c) to `moments` (docs/mathematics.md (13)). */
static inline void triangle_moments(const cell_t* cell, int b, int c, real* moments) {
  real u[DIMENSION], v[DIMENSION], sum2 = 0, squares = 0;
  for (int k = 0; k < DIMENSION; ++k) {
    u[k] = cell->x[k][b] - cell->x[k][0];
    v[k] = cell->x[k][c] - cell->x[k][0];
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
    const real p = cell->x[k][0], q = cell->x[k][b], r = cell->x[k][c], sum = p + q + r;
    moments[1 + k] += area * sum / 3;
    sum2 += sum * sum;
    squares += p * p + q * q + r * r;
  }
  moments[1 + DIMENSION] += area * (sum2 + squares) / 12;
}

/* Nothing to prepare before cell_moments and cell_walls. */
static inline void cell_finish(cell_t* cell) { (void)cell; }

static inline void cell_moments(const cell_t* cell, real* moments) {
  for (int k = 0; k < 2 + DIMENSION; ++k) moments[k] = 0;
  for (int v = 1; v + 1 < cell->vertices; ++v) triangle_moments(cell, v, v + 1, moments);
}

/* Measures of the faces into side[]. */
static inline void cell_walls(cell_t* cell) {
  const int n = cell->vertices;
  for (int v = 0; v < n; ++v) {
    const int next = v + 1 == n ? 0 : v + 1;
    real d[DIMENSION];
    for (int k = 0; k < DIMENSION; ++k) d[k] = cell->x[k][next] - cell->x[k][v];
    cell->side[v] = sqrt(norm2(d));
  }
}

/* A polygon has its vertices in order: nothing to link. */
static inline void cell_write_links(const cell_t* cell, int v, __global uint* link) {
  (void)cell;
  (void)v;
  (void)link;
}

#endif
