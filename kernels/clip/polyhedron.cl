/* A convex polyhedron as a 3-regular graph, cut by half-spaces. Coordinates are relative to the
   seed. Seen from outside, the neighbours next[0..2][v] of vertex v go counter-clockwise; face[k][v]
   lies between next[k][v] and next[k+1][v], and its loop goes from v on to next[k][v]. */
#ifndef POWERCELL_CLIP_POLYHEDRON
#define POWERCELL_CLIP_POLYHEDRON
#include "base/regions.cl"

#define NO_VERTEX ((index_t)(-1))

typedef struct {
  STORAGE_ROWS(real, x, 3, VERTEX_CAPACITY);
  STORAGE_ROWS(index_t, next, 3, VERTEX_CAPACITY);
  STORAGE_ROWS(index_t, face, 3, VERTEX_CAPACITY);
  STORAGE(real, side, VERTEX_CAPACITY); /* per vertex in a cut, per face in cell_walls */
  STORAGE(int, border, FACE_CAPACITY);
  STORAGE(index_t, mark, FACE_CAPACITY);
  int vertices;
  int faces; /* face numbers given out; some may no longer be in use */
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
  cell->vertices = regions.shape->vertices;
  cell->faces = regions.shape->faces;
  cell->reach = 0;
  cell->self = self;
  cell->seeds = seeds;
  cell->corner = regions.corner;
  cell->behind = regions.behind + region * (uint)regions.shape->faces;
  const seed_t seed = seeds[self];
  for (int v = 0; v < cell->vertices; ++v) {
    real y[3];
    difference(regions.corner[regions.vertex[first + (uint)v]], seed, y);
    for (int k = 0; k < 3; ++k) {
      cell->x[k][v] = y[k];
      cell->next[k][v] = (index_t)regions.shape->next[k][v];
      cell->face[k][v] = (index_t)regions.shape->face[k][v];
    }
    cell->reach = fmax(cell->reach, fabs(y[0]) + fabs(y[1]) + fabs(y[2]));
  }
  for (int f = 0; f < cell->faces; ++f) cell->border[f] = ~f;
  return PIECE_WHOLE;
}

/* side[v] = 2 q.y_v - level for all vertices; returns how many exceed the tolerance,
   and in `inside` how many are below its negative. */
static inline int cell_sides(cell_t* cell, const real* q, real level, real tolerance, int* inside) {
  int outside = 0, below = 0;
  const real a = 2 * q[0], b = 2 * q[1], c = 2 * q[2];
  for (int v = 0; v < cell->vertices; ++v) {
    const real s = a * cell->x[0][v] + b * cell->x[1][v] + c * cell->x[2][v] - level;
    cell->side[v] = s;
    outside += s > tolerance;
    below += s < -tolerance;
  }
  *inside = below;
  return outside;
}

/* Forgets the faces that no vertex has, so that their numbers can be given out again. */
static inline void collect_faces(cell_t* cell) {
  for (int f = 0; f < cell->faces; ++f) cell->mark[f] = 0;
  for (int v = 0; v < cell->vertices; ++v)
    for (int k = 0; k < 3; ++k) cell->mark[cell->face[k][v]] = 1;
  int used = 0;
  for (int f = 0; f < cell->faces; ++f)
    if (cell->mark[f]) {
      cell->border[used] = cell->border[f];
      cell->mark[f] = (index_t)used++;
    }
  for (int v = 0; v < cell->vertices; ++v)
    for (int k = 0; k < 3; ++k) cell->face[k][v] = cell->mark[cell->face[k][v]];
  cell->faces = used;
}

/* A new vertex u on the edge from v (kept) by its slot k; `cut` is the new face. mark[left face] = u.
   Returns a CUT code. */
static inline int cut_edge(cell_t* cell, int v, int k, int u, int cut) {
  const int w = cell->next[k][v];
  const real t = fmax((real)0, cell->side[v] / (cell->side[v] - cell->side[w]));
  for (int j = 0; j < 3; ++j) cell->x[j][u] = cell->x[j][v] + t * (cell->x[j][w] - cell->x[j][v]);
  const index_t left = cell->face[k][v];
  cell->next[0][u] = (index_t)v;
  cell->face[0][u] = cell->face[k == 0 ? 2 : k - 1][v];
  cell->face[1][u] = (index_t)cut;
  cell->face[2][u] = left;
  cell->next[k][v] = (index_t)u;
  if (cell->mark[left] != NO_VERTEX) return CUT_TANGLED;
  cell->mark[left] = (index_t)u;
  return CUT_SHRUNK;
}

/* Joins the new vertices n .. n+count-1 into the loop of the new face; it must be one loop. */
static inline int link_cut(cell_t* cell, int n, int count) {
  for (int u = n; u < n + count; ++u) {
    const index_t along = cell->mark[cell->face[0][u]];
    if (along == NO_VERTEX) return CUT_TANGLED;
    cell->next[1][u] = along;
    cell->next[2][along] = (index_t)u;
  }
  int length = 0, u = n;
  do {
    u = cell->next[1][u];
    ++length;
  } while (u != n && length <= count);
  return length == count && count >= 3 ? CUT_SHRUNK : CUT_TANGLED;
}

/* Moves vertex `from` to the free slot `to`. */
static inline void move_vertex(cell_t* cell, int to, int from) {
  for (int k = 0; k < 3; ++k) {
    cell->x[k][to] = cell->x[k][from];
    cell->face[k][to] = cell->face[k][from];
    const int w = cell->next[k][from];
    cell->next[k][to] = (index_t)w;
    for (int j = 0; j < 3; ++j)
      if (cell->next[j][w] == (index_t)from) cell->next[j][w] = (index_t)to;
  }
}

/* Removes the outside vertices among the first n of n + count. */
static inline void drop_outside(cell_t* cell, int n, int count, real tolerance) {
  int last = n + count - 1;
  for (int v = 0; v < n && v <= last; ++v) {
    if (!(cell->side[v] > tolerance)) continue;
    while (last > v && last < n && cell->side[last] > tolerance) --last;
    if (last > v) move_vertex(cell, v, last);
    --last;
  }
  cell->vertices = last + 1;
}

/* Keeps the part with 2 q.y <= level. Vertices within the tolerance of the plane are kept,
   unless nothing else is. Returns a CUT code; after CUT_FULL and CUT_TANGLED the cell is no longer
   usable, after CUT_TOUCH side[] holds. */
static inline int cell_cut(cell_t* cell, const real* q, real level, real tolerance, int border) {
  int inside;
  const int outside = cell_sides(cell, q, level, tolerance, &inside);
  const int n = cell->vertices;
  if (inside == 0) return outside > 0 ? CUT_EMPTY : CUT_WITHIN;
  if (outside == 0) return n - inside >= CELL_DIMENSION ? CUT_TOUCH : CUT_NONE;
  if (cell->faces == FACE_CAPACITY) collect_faces(cell);
  if (cell->faces == FACE_CAPACITY) return CUT_FULL;
  const int cut = cell->faces++;
  cell->border[cut] = border;
  for (int f = 0; f <= cut; ++f) cell->mark[f] = NO_VERTEX;
  int count = 0;
  for (int v = 0; v < n; ++v) {
    if (cell->side[v] > tolerance) continue;
    for (int k = 0; k < 3; ++k) {
      const int w = cell->next[k][v];
      if (w >= n || !(cell->side[w] > tolerance)) continue;
      if (n + count >= VERTEX_CAPACITY) return CUT_FULL;
      if (cut_edge(cell, v, k, n + count, cut) != CUT_SHRUNK) return CUT_TANGLED;
      ++count;
    }
  }
  if (link_cut(cell, n, count) != CUT_SHRUNK) return CUT_TANGLED;
  drop_outside(cell, n, count, tolerance);
  return CUT_SHRUNK;
}

/* Whether face f lies in the plane that side[] was computed for and that nothing is outside of. */
static inline bool cell_face_touches(const cell_t* cell, int f, real tolerance) {
  bool used = false;
  for (int v = 0; v < cell->vertices; ++v)
    for (int k = 0; k < 3; ++k) {
      if (cell->face[k][v] != (index_t)f) continue;
      if (cell->side[v] < -tolerance) return false;
      used = true;
    }
  return used;
}

static inline int cell_faces(const cell_t* cell) { return cell->faces; }

static inline void cross_product(const real* a, const real* b, real* c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Before cell_moments and cell_walls: mark[f] = the first vertex of each face, the apex of its fan of
   triangles. */
static inline void cell_finish(cell_t* cell) {
  collect_faces(cell);
  for (int f = 0; f < cell->faces; ++f) cell->mark[f] = NO_VERTEX;
  for (int v = cell->vertices - 1; v >= 0; --v)
    for (int k = 0; k < 3; ++k) cell->mark[cell->face[k][v]] = (index_t)v;
}

/* The integrals of 1, y and |y|^2: tetrahedra from vertex 0 over a fan of each face
   (docs/mathematics.md (14)). Needs cell_finish. */
static inline void cell_moments(const cell_t* cell, real* moments) {
  for (int k = 0; k < 5; ++k) moments[k] = 0;
  for (int v = 0; v < cell->vertices; ++v)
    for (int k = 0; k < 3; ++k) {
      const int a = cell->mark[cell->face[k][v]], w = cell->next[k][v];
      if (a == 0 || a == v || a == w) continue;
      real r[3], s[3], t[3], c[3], volume = 0, sum2 = 0, squares = 0;
      for (int j = 0; j < 3; ++j) {
        r[j] = cell->x[j][a] - cell->x[j][0];
        s[j] = cell->x[j][v] - cell->x[j][a];
        t[j] = cell->x[j][w] - cell->x[j][a];
      }
      cross_product(s, t, c);
      for (int j = 0; j < 3; ++j) volume += r[j] * c[j];
      volume /= 6;
      moments[0] += volume;
      for (int j = 0; j < 3; ++j) {
        const real o = cell->x[j][0], p = cell->x[j][a], y = cell->x[j][v], z = cell->x[j][w];
        const real sum = o + p + y + z;
        moments[1 + j] += volume * sum / 4;
        sum2 += sum * sum;
        squares += o * o + p * p + y * y + z * z;
      }
      moments[4] += volume * (sum2 + squares) / 20;
    }
}

/* Areas of the faces into side[]. Needs cell_finish. */
static inline void cell_walls(cell_t* cell) {
  for (int f = 0; f < cell->faces; ++f) cell->side[f] = 0;
  for (int v = 0; v < cell->vertices; ++v)
    for (int k = 0; k < 3; ++k) {
      const int f = cell->face[k][v], a = cell->mark[f], w = cell->next[k][v];
      if (a == v || a == w) continue;
      real s[3], t[3], c[3];
      for (int j = 0; j < 3; ++j) {
        s[j] = cell->x[j][v] - cell->x[j][a];
        t[j] = cell->x[j][w] - cell->x[j][a];
      }
      cross_product(s, t, c);
      cell->side[f] += sqrt(norm2(c)) / 2;
    }
}

/* The graph at vertex v: next[0..2], face[0..2]. */
static inline void cell_write_links(const cell_t* cell, int v, __global uint* link) {
  for (int k = 0; k < 3; ++k) {
    link[k] = cell->next[k][v];
    link[3 + k] = cell->face[k][v];
  }
}

#endif
