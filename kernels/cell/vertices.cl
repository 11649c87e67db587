/* The vertices of a cell, in blocks of LANES, relative to the cell's seed: what polygons and polyhedra
   have in common. A slot is a vertex or free; free slots of the blocks in use hold 0. */
#ifndef POWERCELL_CELL_VERTICES
#define POWERCELL_CELL_VERTICES
#include "base/lanes.cl"
#include "base/point.cl"
#include "base/regions.cl"

#define NO_VERTEX ((index_t)(-1))
#define WORD_BITS 64

typedef struct {
  real x[DIMENSION][VERTEX_CAPACITY] FOR_LANES;
  real side[VERTEX_CAPACITY] FOR_LANES; /* of the last plane tried */
  ulong used[VERTEX_WORDS];             /* a bit per slot: it is a vertex */
  ulong outside[VERTEX_WORDS];          /* vertices outside the last plane that cut */
  int blocks;                           /* in use */
  real low[DIMENSION], high[DIMENSION]; /* bounding box, at the last find_box */
  real reach;   /* largest coordinate sum of the region's corners: the scale of rounding errors */
  real extent;  /* no coordinate of a corner is larger: those of the region are brought down to it */
  bool box;     /* the region is a box along the axes (looked for if START_NEAR) */
  bool centred; /* coordinates are relative to `centre`, which is relative to the seed */
  real centre[DIMENSION]; /* c */
  real away;              /* |c_1| + |c_2| + ... */
  real radius;            /* no vertex is farther from the seed */
  real most;              /* largest of side[] */
  real
      gap; /* no plane that cut nothing, but that of `closest`, is nearer to a vertex; below 0: one may cut */
  real closest_gap;  /* how near that of `closest` came; of both, rounding is taken off */
  int closest;       /* the seed, by rank, whose bisector came nearest of those that cut nothing */
  real clear;        /* the same of those that cut */
  real nearest;      /* no vertex, nor the seed, has a smaller |side| (count_sides) */
  real rounding;     /* no vertex is farther from a plane through it, but for what each cut adds */
  real steep, size2; /* least squared sine of a bisector with an edge it cut; 4 |q|^2 of the last one */
  real drift;        /* what cuts add: roundings of their new vertices */
  blur_t blur;       /* of the data (base/real.cl) */
  uint self;         /* rank of the seed */
  __global const seed_t* seeds;  /* all seeds, by rank */
  __global const seed_t* corner; /* vertices of the domain */
  __global const uint* region;   /* the corners of the region */
  __global const int* behind;    /* what lies behind the facets of the region */
} vertices_t;

static inline int words_of(const vertices_t* p) {
  return VERTEX_WORDS == 1 ? 1 : (p->blocks + 7) / 8;
}

static inline void start_vertices(vertices_t* p, regions_t regions, __global const seed_t* seeds, uint self,
                                  __global const uint* region, __global const int* behind) {
  p->blocks = 0;
  p->used[0] = p->outside[0] = 0;
  p->reach = p->radius = 0;
  p->gap = p->closest_gap = p->clear = REAL_MAX / 4;
  p->closest = 0;
  p->steep = 1;
  p->rounding = 0;
  p->drift = 0;
  p->centred = false;
  p->blur = blur_of(seeds[self]);
  p->region = region;
  p->self = self;
  p->seeds = seeds;
  p->corner = regions.corner;
  p->behind = behind;
}

/* Whether a face with that border is one of `faces`, a sum of FACES_.... */
static inline bool is_face_of(const vertices_t* p, int border, uint faces) {
  if (faces == FACES_ALL) return true;
  if (border >= 0) return (faces & FACES_WALLS) != 0;
  return (faces & FACES_BOUNDARY) != 0 && p->behind[~border] == BEHIND_NOTHING;
}

/* Adds a free block. */
static inline void add_block(vertices_t* p) {
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    EACH_LANE(lane) store_lanes(ZERO, p->x[k] + p->blocks * LANES + lane);
  }
  if (p->blocks % 8 == 0) p->used[p->blocks / 8] = p->outside[p->blocks / 8] = 0;
  ++p->blocks;
}

/* Slots in use and free ones of the same blocks. */
static inline int slots_of(const vertices_t* p) {
  return p->blocks * LANES;
}

/* Which of the slots from `v` on, a multiple of LANE_WIDTH, are vertices. */
static inline mask used_lanes(const vertices_t* p, int v) {
  return lanes_of((uint)(p->used[v / WORD_BITS] >> v % WORD_BITS));
}

/* A free slot, or -1 if `capacity` slots are in use. The slot is not marked as used. */
static inline int free_slot(vertices_t* p, int capacity) {
  const int words = words_of(p);
  for (int w = 0; w < words; ++w)
    if (~p->used[w] != 0) {
      const int slot = w * WORD_BITS + lowest_bit(~p->used[w]);
      if (slot < slots_of(p)) return slot;
      break;
    }
  if (slots_of(p) + LANES > capacity) return -1;
  add_block(p);
  return slots_of(p) - LANES;
}

static inline void use_slot(vertices_t* p, int v) {
  p->used[v / WORD_BITS] |= (ulong)1 << v % WORD_BITS;
}

/* Both are known to be false where they are not used, which saves registers. */
static inline bool is_box(const vertices_t* p) {
  return START_NEAR && p->box;
}
static inline bool is_centred(const vertices_t* p) {
  return LEAST_FILLING > 0 && p->centred;
}

/* Finds the bounding box of the vertices. It is kept with them, as everything that outlasts a cut should be:
   what is in variables meanwhile takes registers from all of the cut. */
static inline void find_box(vertices_t* p) {
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    reals l = all_lanes(REAL_MAX), h = all_lanes(-REAL_MAX);
    ONE_BY_ONE for (int v = 0; v < slots_of(p); v += LANE_WIDTH) {
      const mask vertex = used_lanes(p, v);
      const reals x = load_lanes(p->x[k] + v);
      l = each_least(l, choose(l, x, vertex));
      h = each_most(h, choose(h, x, vertex));
    }
    p->low[k] = lane_least(l);
    p->high[k] = lane_most(h);
  }
}

/* Corner k of the region relative to the seed, brought within the extent. */
static inline void find_corner(const vertices_t* p, int k, real* y) {
  difference(p->corner[p->region[k]], p->seeds[p->self], y);
  if (START_NEAR)
    UNROLL for (int c = 0; c < DIMENSION; ++c) y[c] = most_of(least_of(y[c], p->extent), -p->extent);
}

/* The same relative to the centre, to the precision of the result. */
static inline void find_centred_corner(const vertices_t* p, int k, real* y) {
  const parts_t a = parts_of(p->corner[p->region[k]]), b = parts_of(p->seeds[p->self]);
  find_corner(p, k, y);
  UNROLL for (int c = 0; c < DIMENSION; ++c) {
    real low = 0, rest;
    if (fabs(y[c]) < p->extent) {
      y[c] = exact_difference(a.high[c], b.high[c], &low);
      low += a.low[c] - b.low[c];
    }
    y[c] = exact_difference(y[c], p->centre[c], &rest);
    y[c] += low + rest;
  }
}

/* Whether the corners are those of a box along the axes, which has as many dimensions as the space. */
static inline bool corners_of_box(const vertices_t* p, int count) {
  bool box = CELL_DIMENSION == DIMENSION && count == 1 << DIMENSION;
  for (int v = 0; box && v < count; ++v)
    UNROLL for (int k = 0; k < DIMENSION; ++k) box =
        box && (p->x[k][v] == p->low[k] || p->x[k][v] == p->high[k]);
  return box;
}

/* Brings the corners of a box within `extent` of the seed in each coordinate, if enough of the box is there
   (docs/mathematics.md (82b)). */
static inline void shrink_box(vertices_t* p, int count, real extent) {
  find_box(p);
  p->box = corners_of_box(p, count);
  bool near = p->box && extent < p->reach;
  UNROLL for (int k = 0; k < DIMENSION; ++k) near =
      near && 2 * p->low[k] < extent && 2 * p->high[k] > -extent;
  if (!near) return;
  p->extent = extent;
  for (int v = 0; v < count; ++v)
    UNROLL for (int k = 0; k < DIMENSION; ++k) p->x[k][v] = most_of(least_of(p->x[k][v], extent), -extent);
  p->reach = least_of(p->reach, DIMENSION * extent);
}

/* The corners of the region as vertices 0, 1, ... */
static inline void set_corners(vertices_t* p, int count, real extent) {
  p->reach = 0;
  p->extent = REAL_MAX;
  p->box = false;
  while (slots_of(p) < count) add_block(p);
  for (int v = 0; v < count; ++v) {
    real y[DIMENSION], sum = 0;
    difference(p->corner[p->region[v]], p->seeds[p->self], y);
    UNROLL for (int k = 0; k < DIMENSION; ++k) {
      p->x[k][v] = y[k];
      sum += fabs(y[k]);
    }
    p->reach = most_of(sum, p->reach);
  }
  for (int w = 0; w * WORD_BITS < count; ++w)
    p->used[w] = ~(ulong)0 >> (WORD_BITS - min(WORD_BITS, count - w * WORD_BITS));
  if (START_NEAR) shrink_box(p, count, extent);
  p->radius = p->reach;
}

/* Whether no vertex is near the planes that the extent put in place of the region's: then the cell is that of
   the whole region. */
static inline bool clears_extent(vertices_t* p) {
  if (!START_NEAR || p->extent == REAL_MAX) return true;
  real most = 0;
  find_box(p);
  UNROLL for (int k = 0; k < DIMENSION; ++k) most = most_of(most, most_of(p->high[k], -p->low[k]));
  return most < (1 - SEARCH_MARGIN) * p->extent;
}

/* Takes coordinates relative to the middle of the vertices from here on. */
static inline void recentre(vertices_t* p) {
  find_box(p);
  p->away = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    p->centre[k] = (p->low[k] + p->high[k]) / 2;
    p->away += fabs(p->centre[k]);
  }
  for (int w = 0; w < words_of(p); ++w)
    for (ulong bits = p->used[w]; bits != 0; bits &= bits - 1)
      UNROLL for (int k = 0; k < DIMENSION; ++k) p->x[k][w * WORD_BITS + lowest_bit(bits)] -= p->centre[k];
  p->centred = true;
}

/* Takes them relative to the seed again. */
static inline void leave_centre(vertices_t* p) {
  for (int w = 0; w < words_of(p); ++w)
    for (ulong bits = p->used[w]; bits != 0; bits &= bits - 1)
      UNROLL for (int k = 0; k < DIMENSION; ++k) p->x[k][w * WORD_BITS + lowest_bit(bits)] += p->centre[k];
  p->centred = false;
}

/* Frees the slots of `outside`. */
static inline void drop_outside(vertices_t* p) {
  for (int w = 0; w < words_of(p); ++w) {
    p->used[w] &= ~p->outside[w];
    for (ulong bits = p->outside[w]; bits != 0; bits &= bits - 1)
      UNROLL for (int k = 0; k < DIMENSION; ++k) p->x[k][w * WORD_BITS + lowest_bit(bits)] = 0;
  }
}

/* side[v] = 2 q.y_v - offset for all slots; returns the largest (that of free slots is -offset). */
static inline real find_sides(vertices_t* p, const real* q, real offset) {
  reals most = all_lanes(-REAL_MAX), a[DIMENSION];
  const reals l = all_lanes(offset);
  UNROLL for (int k = 0; k < DIMENSION; ++k) a[k] = all_lanes(2 * q[k]);
  ONE_BY_ONE for (int v = 0; v < slots_of(p); v += LANE_WIDTH) {
    reals s = a[0] * load_lanes(p->x[0] + v);
    UNROLL for (int k = 1; k < DIMENSION; ++k) s = s + a[k] * load_lanes(p->x[k] + v);
    s = s - l;
    store_lanes(s, p->side + v);
    most = each_most(most, s);
  }
  p->most = lane_most(most);
  return p->most;
}

/* How many vertices are inside by more than the tolerance, by side[]. */
static inline int count_inside(const vertices_t* p, real tolerance) {
  int inside = 0;
  for (int w = 0; w < words_of(p); ++w) {
    ulong in = 0;
    const real* side = p->side + w * WORD_BITS;
    const int end = min(WORD_BITS, slots_of(p) - w * WORD_BITS);
    ONE_BY_ONE for (int v = 0; v < end; v += LANE_WIDTH) in |=
        (ulong)lane_bits(load_lanes(side + v) < all_lanes(-tolerance)) << v;
    inside += (int)popcount(in & p->used[w]);
  }
  return inside;
}

/* How many vertices are beyond the tolerance on either side, by side[]. Those outside go to `outside`. */
static inline int count_sides(vertices_t* p, real tolerance, int* vertices, int* inside) {
  int outside = 0, all = 0;
  reals nearest = all_lanes(REAL_MAX);
  for (int w = 0; w < words_of(p); ++w) {
    ulong out = 0;
    const real* side = p->side + w * WORD_BITS;
    const int end = min(WORD_BITS, slots_of(p) - w * WORD_BITS);
    ONE_BY_ONE for (int v = 0; v < end; v += LANE_WIDTH) {
      const reals s = load_lanes(side + v);
      out |= (ulong)lane_bits(s > all_lanes(tolerance)) << v;
      nearest = each_least(nearest, each_size(s));
    }
    p->outside[w] = out & p->used[w];
    outside += (int)popcount(p->outside[w]);
    all += (int)popcount(p->used[w]);
  }
  p->nearest = lane_least(nearest);
  *vertices = all;
  *inside = p->nearest > tolerance ? all - outside : count_inside(p, tolerance);
  return outside;
}

static inline bool is_outside(const vertices_t* p, int v) {
  return (p->outside[v / WORD_BITS] >> v % WORD_BITS & 1) != 0;
}

/* Vertex u becomes the point on the edge from `in` (kept) to `out` in the plane that side[] is of. */
static inline void set_edge_point(vertices_t* p, int u, int in, int out) {
  const real drop = p->side[in] - p->side[out], t = most_of(p->side[in] / drop, 0);
  real length2 = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const real d = p->x[k][out] - p->x[k][in];
    p->x[k][u] = p->x[k][in] + t * d;
    length2 += d * d;
  }
  if (QUICK_PROOF) {
    const real sine2 = drop * drop / (p->size2 * length2);
    p->steep = least_of(sine2 >= 0 ? sine2 : 0, p->steep); /* 0 for NaN, where numbers are out of range */
  }
  use_slot(p, u);
}

/* Largest squared distance of a vertex from the seed. */
static inline real find_radius2(vertices_t* p) {
  reals most = ZERO;
  ONE_BY_ONE for (int v = 0; v < slots_of(p); v += LANE_WIDTH) {
    reals s = ZERO;
    UNROLL for (int k = 0; k < DIMENSION; ++k) {
      const reals x = load_lanes(p->x[k] + v);
      s = s + x * x;
    }
    most = each_most(most, s);
  }
  const real radius2 = lane_most(most);
  p->radius = sqrt(radius2) * (1 + 8 * REAL_EPSILON);
  return radius2;
}

#endif
