/* A convex polyhedron as a 3-regular graph, cut by half-spaces. Seen from outside, the neighbours
   next[v][0..2] of vertex v go counter-clockwise; face[v][k] lies between next[v][k] and next[v][k+1], and
   its loop goes from v on to next[v][k]. */
#ifndef POWERCELL_CELL_POLYHEDRON
#define POWERCELL_CELL_POLYHEDRON
#include "cell/certain.cl"

typedef struct {
  vertices_t at;
  /* The last of each is not used: what belongs to a vertex is one word, which a GPU loads once. */
  index_t next[VERTEX_CAPACITY][4] __attribute__((aligned(4)));
  index_t face[VERTEX_CAPACITY][4] __attribute__((aligned(4)));
  int border[FACE_CAPACITY];
  index_t mark[FACE_CAPACITY];  /* NO_VERTEX between cuts */
  real4 point[VERTEX_CAPACITY]; /* for cell_certain, then for the moments */
  real4 normal[FACE_CAPACITY];  /* of the bisectors (q, offset) until cell_moments, then of the faces */
  real doubt[FACE_CAPACITY];    /* for cell_certain */
  __global const region_shape_t* shape; /* of the region */
  int faces;                            /* face numbers assigned; some may be unused */
} cell_t;

/* The region as the cell of seed `self`; of a box around the seed only what is within `extent` in each
   coordinate. Returns a PIECE status. */
static inline int cell_start(cell_t* cell, regions_t regions, __global const seed_t* seeds, uint self,
                             uint region, real extent) {
  const uint first = regions.offset[region];
  cell->faces = regions.shape->faces;
  cell->shape = regions.shape;
  start_vertices(&cell->at, regions, seeds, self, regions.vertex + first,
                 regions.behind + region * (uint)cell->faces);
  set_corners(&cell->at, regions.shape->vertices, extent);
  for (int v = 0; v < regions.shape->vertices; ++v) {
    UNROLL for (int k = 0; k < 3; ++k) {
      cell->next[v][k] = (index_t)regions.shape->next[k][v];
      cell->face[v][k] = (index_t)regions.shape->face[k][v];
    }
  }
  for (int f = 0; f < cell->faces; ++f) cell->border[f] = ~f;
  for (int f = 0; f < FACE_CAPACITY; ++f) cell->mark[f] = NO_VERTEX;
  return PIECE_DONE;
}

/* The plane of facet `f` of the region, by a corner and the two edges beside it that the shape puts f
 * between. */
static inline certain_plane_t region_plane(const cell_t* cell, int f) {
  int v = 0, k = 0;
  while (cell->shape->face[k][v] != f)
    if (++k == 3) {
      k = 0;
      ++v;
    }
  const real4 y = region_corner(&cell->at, v);
  const real4 a = region_corner(&cell->at, cell->shape->next[k][v]) - y;
  const real4 b = region_corner(&cell->at, cell->shape->next[k == 2 ? 0 : k + 1][v]) - y;
  return facet_plane(&cell->at, y, a, b, cross3(a, b));
}

/* The plane of face f, with unit normal. */
static inline certain_plane_t face_plane(const cell_t* cell, int f) {
  return cell->border[f] < 0 ? region_plane(cell, ~cell->border[f])
                             : border_plane(&cell->at, cell->border[f], cell->normal[f]);
}

/* What face f lies in: 2 q.y = offset. */
static inline void set_face_plane(cell_t* cell, int f, const real* q, real offset) {
  cell->normal[f] = make_real4(q[0], q[1], q[DIMENSION - 1], offset);
}

/* The first face from f on that no vertex has and whose plane may come nearer than the gap; where there is
   none, the number of faces. */
static inline int next_to_forget(const cell_t* cell, int f, removed_t* removed) {
  for (; f < cell->faces; ++f) {
    if (cell->mark[f] != NO_VERTEX) continue;
    const int border = cell->border[f];
    *removed = border < 0 ? removed_facet(&cell->at, region_plane(cell, ~border), border)
                          : removed_bisector(&cell->at, cell->normal[f], border);
    if (may_be_gap(&cell->at, *removed)) break;
  }
  return f;
}

/* Before the numbers of faces that no vertex has are given out again. Work-items search for such a face
   first, so that they look at its plane together. */
static inline void forget_faces(cell_t* cell) {
  removed_t removed;
  for (int f = next_to_forget(cell, 0, &removed); f < cell->faces; f = next_to_forget(cell, f + 1, &removed))
    note_removed(&cell->at, removed);
}

/* Forgets the faces that no vertex has, so that their numbers can be given out again; notes the gaps to them
   if `note`, and then side[] does not hold afterwards. */
static inline void collect_faces(cell_t* cell, bool note) {
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1)
      UNROLL for (int k = 0; k < 3; ++k) cell->mark[cell->face[w * WORD_BITS + lowest_bit(bits)][k]] = 0;
  if (note) forget_faces(cell);
  int used = 0;
  for (int f = 0; f < cell->faces; ++f)
    if (cell->mark[f] != NO_VERTEX) {
      cell->border[used] = cell->border[f];
      cell->normal[used] = cell->normal[f];
      cell->mark[f] = (index_t)used++;
    }
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      UNROLL for (int k = 0; k < 3; ++k) cell->face[v][k] = cell->mark[cell->face[v][k]];
    }
  for (int f = 0; f < cell->faces; ++f) cell->mark[f] = NO_VERTEX;
  cell->faces = used;
}

/* Slot k of vertex v with next[v][k] == w. */
static inline int slot_to(const cell_t* cell, int v, int w) {
  return (cell->next[v][1] == (index_t)w) + 2 * (cell->next[v][2] == (index_t)w);
}

/* A new vertex on the edge from `out` by its slot k to `in`, which is kept; `cut` is the new face. The mark
   of the face left of the edge seen from `in` tells the new vertex, which is returned, or -1 if there is no
   room. */
static inline int cut_edge(cell_t* cell, int out, int k, int in, int cut) {
  const int u = free_slot(&cell->at, VERTEX_CAPACITY);
  if (u < 0) return u;
  const index_t left = cell->face[out][k == 0 ? 2 : k - 1];
  set_edge_point(&cell->at, u, in, out);
  cell->next[u][0] = (index_t)in;
  cell->face[u][0] = cell->face[out][k];
  cell->face[u][1] = (index_t)cut;
  cell->face[u][2] = left;
  cell->next[in][slot_to(cell, in, out)] = (index_t)u;
  cell->mark[left] = (index_t)u;
  return u;
}

/* Joins the `count` new vertices, `first` one of them, into the loop of the new face; it must be one loop.
   Takes the marks away. Returns a CUT code. */
static inline int link_cut(cell_t* cell, int first, int count) {
  int length = 0, u = first;
  do {
    const index_t face = cell->face[u][0], along = cell->mark[face];
    if (along == NO_VERTEX) return CUT_TANGLED;
    cell->mark[face] = NO_VERTEX;
    cell->next[u][1] = along;
    cell->next[along][2] = (index_t)u;
    u = along;
    ++length;
  } while (u != first);
  return length == count && count >= 3 ? CUT_SHRUNK : CUT_TANGLED;
}

/* Lists the edges from vertices of word w outside to others, as slot within the word times 4 plus k; returns
   their number. Which edges these are is anybody's guess, so there is no branch to be taken wrong. */
static inline int list_cut_edges(const cell_t* cell, int w, uchar* edge) {
  int count = 0;
  for (ulong bits = cell->at.outside[w]; bits != 0; bits &= bits - 1) {
    const int bit = lowest_bit(bits);
    UNROLL for (int k = 0; k < 3; ++k) {
      edge[count] = (uchar)(4 * bit + k);
      count += is_outside(&cell->at, cell->next[w * WORD_BITS + bit][k]) ? 0 : 1;
    }
  }
  return count;
}

/* Cuts all edges from vertices outside to others, and links the new vertices. */
static inline int cut_outside(cell_t* cell, int cut) {
  int count = 0, u = 0;
  uchar edge[3 * WORD_BITS];
  const int words = words_of(&cell->at); /* new vertices may add words */
  for (int w = 0; w < words; ++w) {
    const int edges = list_cut_edges(cell, w, edge);
    for (int e = 0; e < edges; ++e) {
      const int out = w * WORD_BITS + edge[e] / 4, k = edge[e] % 4;
      u = cut_edge(cell, out, k, cell->next[out][k], cut);
      if (u < 0) return CUT_FULL;
    }
    count += edges;
  }
  return count == 0 ? CUT_TANGLED : link_cut(cell, u, count);
}

/* Keeps the part with 2 q.y <= offset. Vertices within the tolerance of the plane are kept,
   unless nothing else is. Returns a CUT code; after CUT_FULL and CUT_TANGLED the cell is no longer
   usable, after CUT_TOUCH side[] holds. */
static inline int cell_cut(cell_t* cell, const real* q, real offset, real tolerance, int border) {
  if (find_sides(&cell->at, q, offset) < -tolerance) return CUT_NONE;
  int inside, vertices;
  const int outside = count_sides(&cell->at, tolerance, &vertices, &inside);
  if (inside == 0) return outside > 0 ? CUT_EMPTY : CUT_WITHIN;
  if (outside == 0) return vertices - inside >= CELL_DIMENSION ? CUT_TOUCH : CUT_NONE;
  if (cell->faces == FACE_CAPACITY) {
    collect_faces(cell, true);
    find_sides(&cell->at, q, offset);
  }
  if (cell->faces == FACE_CAPACITY) return CUT_FULL;
  const int cut = cell->faces++;
  cell->border[cut] = border;
  set_face_plane(cell, cut, q, offset);
  const int result = cut_outside(cell, cut);
  if (result != CUT_SHRUNK) return result;
  drop_outside(&cell->at);
  return CUT_SHRUNK;
}

/* Faces are numbered up to here; some may be none. */
static inline int cell_faces(const cell_t* cell) {
  return cell->faces;
}

/* Whether face f lies in the plane that side[] was computed for and that nothing is outside of. */
static inline bool cell_face_touches(const cell_t* cell, int f, real tolerance) {
  bool used = false;
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      UNROLL for (int k = 0; k < 3; ++k) {
        if (cell->face[v][k] != (index_t)f) continue;
        if (cell->at.side[v] < -tolerance) return false;
        used = true;
      }
    }
  return used;
}

/* point[v] = where the three planes of vertex v meet, and at least the error of that in w. False if some
   planes are nearly dependent. No loop of the proof ends early: work-items that go on alone after that
   cost more than is saved. */
static inline bool find_places(cell_t* cell) {
  bool found = true;
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      const int a = cell->face[v][0], b = cell->face[v][1], c = cell->face[v][2];
      const certain_plane_t pa = {cell->normal[a], cell->doubt[a]}, pb = {cell->normal[b], cell->doubt[b]},
                            pc = {cell->normal[c], cell->doubt[c]};
      real4 y = vertex_point(&cell->at, v);
      const bool corner = !is_centred(&cell->at) && (cell->border[a] & cell->border[b] & cell->border[c]) < 0;
      if (corner) /* of the region */
        y.w = corner_error(&cell->at);
      else
        y = meeting_point(&cell->at, y, pa, pb, pc);
      cell->point[v] = y;
      found = found && !(y.w < 0);
    }
  return found;
}

/* Whether each edge goes inwards from the face across its start: then the faces bound the intersection of
   their half-spaces, and no other polyhedron. Needs find_places. */
static inline bool edges_are_certain(const cell_t* cell) {
  bool certain = true;
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      UNROLL for (int k = 0; k < 3; ++k) {
        const int u = cell->next[v][k], f = cell->face[v][k == 2 ? 0 : k + 1];
        const certain_plane_t plane = {cell->normal[f], cell->doubt[f]};
        if (u > v) certain = is_inside(&cell->at, cell->point[u], cell->point[u].w, plane) && certain;
      }
    }
  return certain;
}

/* Proves the shape of the cell from its faces alone, whatever rounding did on the way to it; the vertices are
   better afterwards. Returns at least the distance of the vertices as they were from the true ones, or below
   0 if the shape is not certain: then the vertices are as they were. */
static inline real cell_certain(cell_t* cell) {
  real worst = 0;
  bool known = true;
  find_radius2(&cell->at);
  for (int f = 0; f < cell->faces; ++f) {
    const certain_plane_t unit = face_plane(cell, f);
    /* else the square of q is nothing, but cell_moments needs its direction */
    if (unit.doubt < REAL_MAX) cell->normal[f] = unit.plane;
    cell->doubt[f] = unit.doubt;
    known = known && unit.doubt < REAL_MAX;
  }
  if (!known || !find_places(cell) || !edges_are_certain(cell)) return -1;
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      worst = fmax(worst, move_vertex(&cell->at, v, cell->point[v]));
    }
  return worst;
}

/* Before the functions below and, with `note`, before cell_certain: mark[f] = the first vertex of each face,
   the apex of its fan of triangles. */
static inline void cell_finish(cell_t* cell, bool note) {
  collect_faces(cell, note);
  for (int w = words_of(&cell->at) - 1; w >= 0; --w)
    for (ulong bits = cell->at.used[w]; bits != 0;) {
      const int bit = 63 - (int)clz(bits), v = w * WORD_BITS + bit;
      bits &= ~((ulong)1 << bit);
      UNROLL for (int k = 0; k < 3; ++k) cell->mark[cell->face[v][k]] = (index_t)v;
    }
}

/* Whether the cell may go on in other regions. Needs cell_finish. */
static inline bool cell_goes_on(const cell_t* cell) {
  for (int f = 0; f < cell->faces; ++f)
    if (cell->border[f] < 0 && cell->at.behind[~cell->border[f]] != BEHIND_NOTHING) return true;
  return false;
}

/* Outward unit normal of face f and, in w, how far `top` lies behind its plane. */
static inline real4 face_height(const cell_t* cell, int f, real4 top) {
  real4 n = cell->border[f] < 0 ? region_plane(cell, ~cell->border[f]).plane : cell->normal[f];
  n.w = 0;
  n = n * (1 / fmax(fmax(fabs(n.x), fabs(n.y)),
                    fmax(fabs(n.z), REAL_LEAST))); /* seeds may be next to nothing apart */
  n = n * (1 / sqrt(dot3(n, n)));
  n.w = dot3(n, cell->point[cell->mark[f]] - top);
  return n;
}

/* Adds the integrals over the tetrahedron of `top` and the triangle a, v, w in the face of that height, all
   with |y|^2 in the last component: to sums those of 1 and of 24 y, and to `squares` parts of that of 120
   |y|^2 (docs/mathematics.md (14)). Returns twice the area of the triangle. By the face's own normal: that of
   the triangle would be lost in rounding where the cell is a needle. */
static inline real tetrahedron_moments(real4 top, real4 a, real4 v, real4 w, real4 height, real* volume,
                                       real4* sums, real4* squares) {
  const real4 sum = (top + a) + (v + w);
  const real area = dot3(cross3(v - a, w - a), height), part = area * height.w;
  const real4 weighted = sum * part;
  *volume += part;
  *sums = *sums + weighted;
  *squares = *squares + weighted * sum;
  return area;
}

/* The integrals of 1, y and |y|^2, by the tetrahedra from one vertex over a fan of each face; side[f] = area
   of face f, where `walls` are asked for. Needs cell_finish. */
static inline void cell_moments(cell_t* cell, bool walls, real* moments) {
  const int words = words_of(&cell->at);
  int first = 0;
  for (int w = words - 1; w >= 0; --w) {
    if (cell->at.used[w] != 0) first = w * WORD_BITS + lowest_bit(cell->at.used[w]);
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      const real x = cell->at.x[0][v], y = cell->at.x[1][v], z = cell->at.x[2][v];
      cell->point[v] = make_real4(x, y, z, x * x + y * y + z * z);
    }
  }
  const real4 zero = make_real4(0, 0, 0, 0), top = cell->point[first];
  real4 sums = zero, squares = zero;
  real volume = 0;
  for (int f = 0; f < cell->faces; ++f) {
    cell->normal[f] = face_height(cell, f, top);
    if (walls) cell->at.side[f] = 0;
  }
  for (int w = 0; w < words; ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      UNROLL for (int k = 0; k < 3; ++k) {
        const int f = cell->face[v][k];
        const real area =
            tetrahedron_moments(top, cell->point[cell->mark[f]], cell->point[v],
                                cell->point[cell->next[v][k]], cell->normal[f], &volume, &sums, &squares);
        if (walls) cell->at.side[f] += area;
      }
    }
  if (walls)
    for (int f = 0; f < cell->faces; ++f) cell->at.side[f] = fabs(cell->at.side[f]) / 2;
  moments[0] = volume / 6;
  moments[1] = sums.x / 24;
  moments[2] = sums.y / 24;
  moments[3] = sums.z / 24;
  moments[4] = (sums.w + squares.x + squares.y + squares.z) / 120;
}

/* Writes what lies behind the faces and their areas, of those that are of `faces` (a sum of FACES_...),
   unless `border` is null; returns their number. Needs cell_moments with walls. */
static inline int cell_write_walls(cell_t* cell, uint faces, __global int* border,
                                   __global stored_real* wall) {
  int count = 0;
  for (int f = 0; f < cell->faces; ++f) {
    if (!is_face_of(&cell->at, cell->border[f], faces)) continue;
    if (border) {
      border[count] = cell->border[f];
      wall[count] = (stored_real)cell->at.side[f];
    }
    ++count;
  }
  return count;
}

/* Writes the vertices and the graph at each: next[0..2], face[0..2]. Returns their number. */
static inline int cell_write_vertices(cell_t* cell, __global stored_real* vertex, __global uint* link) {
  int count = 0;
  for (int w = 0; w < words_of(&cell->at); ++w) /* side[v] = number of vertex v */
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1)
      cell->at.side[w * WORD_BITS + lowest_bit(bits)] = (real)count++;
  int number = 0;
  for (int w = 0; w < words_of(&cell->at); ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1, ++number) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      UNROLL for (int k = 0; k < 3; ++k) {
        vertex[number * 3 + k] = (stored_real)cell->at.x[k][v];
        link[number * 6 + k] = (uint)cell->at.side[cell->next[v][k]];
        link[number * 6 + 3 + k] = cell->face[v][k];
      }
    }
  return count;
}

#endif
