/* clang-format off */
/* Proofs that rounding did not change the shape of a cell (docs/mathematics.md, "Certain decisions"): the parts
   common to polygons and polyhedra. L is the unit of length of the cell; symbols are those of (80)-(84).

   name         unit    meaning                                               computed in                   symbol
   radius       L       no vertex is farther from the seed, or the centre     find_radius2                  R
   blur         L, L^2  errors of a coordinate and of a weight as stored      blur_of (base/real.cl)        b, b_w
   doubt        L       error of a plane of unit normal within the radius     unit_plane, facet_plane       delta_f
   y.w, side[]  L       error of a vertex solved from its planes              meeting_point, move_vertex    e_v
   moved        L       largest error of a vertex as the cuts left it         move_vertex, cell_certain     max |y_v - y*_v|
   drift        L       rounding of the new vertices of all cuts (floats:     note_drift                    drift
                        of those since the first gap)
   gap          L       least distance, minus rounding, of the vertices       note_gap, note_removed        min gap_j
                        from the planes that cut nothing or whose faces
                        are gone, except that of `closest`
   closest_gap  L       the same of the bisector that came nearest            note_gap                      min gap_j
   clear        L       the same of a vertex or the seed from                 note_cut                      min |s_j|/2|q_j|_1
                        the planes that cut
   rounding     L       largest residual of a vertex in a plane through it    note_cut                      r
                        (quickly_certain adds corner_error and the drift)
   steep        1       least squared sine of a bisector with an edge it cut  set_edge_point                kappa^2

   Distances from planes are divided by |q|_1, which makes them lower bounds. (84) takes the least of gap,
   closest_gap and clear; (82) compares moved + drift with gap, and with closest_gap or else vertex by vertex. */
/* clang-format on */
#ifndef POWERCELL_CELL_CERTAIN
#define POWERCELL_CELL_CERTAIN
#include "cell/vertices.cl"

/* The plane n.y = h with |n| = 1 (n in x, y, z; h in w) as computed is this near to the true one, within the
   radius of the cell. */
typedef struct {
  real4 plane;
  real doubt;
} certain_plane_t;

/* Error of a corner of the region. */
static inline real corner_error(const vertices_t* p) {
  return 2 * (REAL_EPSILON * p->reach + p->blur.position);
}

/* A bound for the error of 2 q.y - offset at the vertices as computed. `sum` = |q_1| + |q_2| + ..., q2 = q.q,
   dw the difference of the weights. */
static inline real plane_error(const vertices_t* p, real sum, real q2, real dw) {
  return REAL_EPSILON * (8 * sum * p->radius + 4 * (q2 + fabs(dw))) + plane_blur(p->blur, p->radius, sum);
}

/* Largest of side[] of a vertex. */
static inline real most_of_used(const vertices_t* p) {
  real most = -REAL_MAX;
  for (int w = 0; w < words_of(p); ++w)
    for (ulong bits = p->used[w]; bits != 0; bits &= bits - 1)
      most = fmax(most, p->side[w * WORD_BITS + lowest_bit(bits)]);
  return most;
}

/* Adds the rounding of a cut: apart from it, the new vertices lie between the old ones. The proof from the
   end needs the drift only since the first gap. */
static inline void note_drift(vertices_t* p) {
  if (QUICK_PROOF || least_of(p->gap, p->closest_gap) < REAL_MAX / 8)
    p->drift += 2 * REAL_EPSILON * p->radius;
}

/* Updates `clear` and `rounding` for a plane that cuts the cell or leaves nothing of it. To be called after
   count_sides. */
static inline void note_cut(vertices_t* p, real sum, real error) {
  const real scale = 1 / (2 * sum), clear = (p->nearest - error) * scale;
  error += 12 * REAL_EPSILON * sum * p->radius; /* of the ratio in set_edge_point */
  p->clear = least_of(clear, p->clear);
  p->rounding = most_of(error * scale, p->rounding);
}

/* Whether (84) holds: by the worst bounds over all cuts, rounding has made no decision. */
static inline bool quickly_certain(const vertices_t* p) {
  const real rounding = p->rounding + corner_error(p) + p->drift;
  const real gap = fmin(fmin(p->gap, p->closest_gap), p->clear);
  const real steep = DIMENSION == 2 ? sqrt(p->steep) : p->steep;
  return QUICK_PROOF && 16 * rounding < steep * fmin(gap, SEARCH_MARGIN / 16 * p->radius);
}

/* Updates the gaps for the plane 2 q.y = offset of `border`, which cuts nothing. To be called after
 * find_sides. */
static inline void note_gap(vertices_t* p, real sum, real offset, real error, int border) {
  const real clear = -(offset < 0 ? most_of_used(p) : p->most) - error; /* free slots count as -offset */
  const real gap = clear / (2 * sum);
  const bool closest = gap < p->closest_gap && border >= 0;
  p->gap = least_of(closest ? p->closest_gap : gap, p->gap);
  p->closest_gap = closest ? gap : p->closest_gap;
  p->closest = closest ? border : p->closest;
}

/* The plane 2 q.y = offset of a face that no vertex has any more: q in x, y, z and the offset in w. */
typedef struct {
  real4 raw;
  real sum, error;
  int border;
} removed_t;

/* Of a bisector. Its error does not follow from its offset, in which |q|^2 and weights may cancel. */
static inline removed_t removed_bisector(const vertices_t* p, real4 raw, int border) {
  const real sum = fabs(raw.x) + fabs(raw.y) + fabs(raw.z),
             q2 = raw.x * raw.x + raw.y * raw.y + raw.z * raw.z;
  const removed_t removed = {raw, sum, plane_error(p, sum, q2, raw.w - q2), border};
  return removed;
}

/* Whether the plane may come nearer than the gap, by the radius of the cell. */
static inline bool may_be_gap(const vertices_t* p, removed_t removed) {
  return !(removed.raw.w - removed.error - 2 * removed.sum * p->radius >= 2 * removed.sum * p->gap);
}

/* Updates the gaps for the plane of a removed face. */
static inline void note_removed(vertices_t* p, removed_t removed) {
  real normal[DIMENSION];
  normal[0] = removed.raw.x;
  normal[1] = removed.raw.y;
  if (DIMENSION == 3) normal[DIMENSION - 1] = removed.raw.z;
  find_sides(p, normal, removed.raw.w);
  note_gap(p, removed.sum, removed.raw.w, removed.error, removed.border);
}

/* Scales the plane (q, offset) of 2 q.y = offset, known to rounding, to a unit normal. Where the errors of
   the data exceed rounding, the doubt is so large that nothing about the plane is certain: the host then
   computes the cell to more digits. */
static inline certain_plane_t unit_plane(const vertices_t* p, real4 raw) {
  certain_plane_t unit;
  const real size = sqrt(raw.x * raw.x + raw.y * raw.y + raw.z * raw.z), scale = 1 / size;
  const real h = raw.w * scale * (real)0.5;
  real rounding = REAL_EPSILON * (3 * p->radius + 2 * size + fabs(h));
  real data = plane_blur(p->blur, p->radius, size) * (scale / 2);
  if (is_centred(p)) { /* by (82c) */
    rounding = REAL_EPSILON * (3 * p->radius + fabs(h));
    data = plane_blur(p->blur, p->radius + p->away, size) * (scale / 2) +
           32 * REAL_EPSILON * REAL_EPSILON * (p->radius + p->away + size);
  }
  unit.plane = make_real4(raw.x * scale, raw.y * scale, raw.z * scale, h);
  unit.doubt = data > MOST_BLUR * rounding ? 4 * p->radius + data : rounding + data;
  return unit;
}

/* The plane (q, offset) of 2 q.y = offset, the bisector with seed `other` (3). */
static inline real4 raw_bisector(const vertices_t* p, int other) {
  const seed_t seed = p->seeds[p->self], there = p->seeds[other];
  real q[DIMENSION];
  difference(there, seed, q);
  return make_real4(q[0], q[1], DIMENSION == 3 ? q[DIMENSION - 1] : 0,
                    norm2(q) + weight_difference(seed, there));
}

/* The same about the centre, 2 q.(y - c) = q.(q - 2 c) + w_i - w_j, to the precision of the result although
   the terms may cancel. */
static inline real4 centred_bisector(const vertices_t* p, int other) {
  const parts_t a = parts_of(p->seeds[other]), b = parts_of(p->seeds[p->self]);
  real q[3] = {0, 0, 0}, low, rest, sum = exact_difference(b.high[3], a.high[3], &low);
  low += b.low[3] - a.low[3];
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    real q_low, u_low;
    q[k] = exact_difference(a.high[k], b.high[k], &q_low);
    q_low += a.low[k] - b.low[k];
    normalize_parts(&q[k], &q_low);
    const real u = exact_difference(q[k], 2 * p->centre[k], &u_low), product = q[k] * u;
    low += fma(q[k], u, -product) + (q[k] * (u_low + q_low) + q_low * u);
    sum = exact_difference(sum, -product, &rest);
    low += rest;
  }
  return make_real4(q[0], q[1], q[2], sum + low);
}

/* The plane of `border` with unit normal; `raw` is (q, offset) of it, relative to the seed. */
static inline certain_plane_t border_plane(const vertices_t* p, int border, real4 raw) {
  return unit_plane(p, is_centred(p) ? centred_bisector(p, border) : raw);
}

/* Corner k of the region, within the extent; .w is 0. */
static inline real4 region_corner(const vertices_t* p, int k) {
  real y[DIMENSION];
  if (is_centred(p))
    find_centred_corner(p, k, y);
  else
    find_corner(p, k, y);
  return make_real4(y[0], y[1], DIMENSION == 3 ? y[DIMENSION - 1] : 0, 0);
}

/* The plane through y with normal n = a x b, which is outward. Of a box the normal is along an axis, and the
   plane is off by no more than y. About a centre, no other is known to enough digits. */
static inline certain_plane_t facet_plane(const vertices_t* p, real4 y, real4 a, real4 b, real4 n) {
  certain_plane_t unit;
  const real size = sqrt(dot3(n, n)), scale = 1 / size;
  unit.plane = n * scale;
  unit.plane.w = dot3(unit.plane, y);
  unit.doubt =
      (16 * REAL_EPSILON * p->reach + 8 * p->blur.position) * (sqrt(dot3(a, a) * dot3(b, b)) * scale);
  if (is_box(p)) unit.doubt = 8 * (REAL_EPSILON * fabs(unit.plane.w) + p->blur.position);
  if (is_centred(p) && !is_box(p)) unit.doubt = REAL_MAX;
  return unit;
}

/* Vertex v; .w is 0. */
static inline real4 vertex_point(const vertices_t* p, int v) {
  return make_real4(p->x[0][v], p->x[1][v], DIMENSION == 3 ? p->x[DIMENSION - 1][v] : 0, 0);
}

/* As a raw plane. */
static inline real4 raw_plane(certain_plane_t unit) {
  return make_real4(unit.plane.x, unit.plane.y, unit.plane.z, 2 * unit.plane.w);
}

/* Of a facet of the region. */
static inline removed_t removed_facet(const vertices_t* p, certain_plane_t facet, int border) {
  const real sum = fabs(facet.plane.x) + fabs(facet.plane.y) + fabs(facet.plane.z);
  const real error = REAL_EPSILON * (8 * sum * p->radius + 8 * fabs(facet.plane.w)) + 2 * sum * facet.doubt;
  const removed_t removed = {raw_plane(facet), sum, error, border};
  return removed;
}

/* Solves for the point where three planes meet; w is its error (80), below 0 if the planes are nearly
   dependent or not oriented as at a vertex of a cell. `from` (w: 0) is an estimate: the nearer it is, the
   nearer the result lies to each plane. For nearly dependent planes it may be off along their common line
   only, which keeps the measure right. */
static inline real4 meeting_point(const vertices_t* p, real4 from, certain_plane_t a, certain_plane_t b,
                                  certain_plane_t c) {
  const real4 bc = cross3(b.plane, c.plane), ca = cross3(c.plane, a.plane), ab = cross3(a.plane, b.plane);
  const real d = dot3(a.plane, bc), scale = 1 / d;
  const real sum = fabs(a.plane.w) + fabs(b.plane.w) + fabs(c.plane.w);
  const real ra = a.plane.w - dot3(a.plane, from), rb = b.plane.w - dot3(b.plane, from),
             rc = c.plane.w - dot3(c.plane, from);
  real4 y = from + (bc * ra + ca * rb + ab * rc) * scale;
  const real error =
      (real)1.125 * scale * (a.doubt + b.doubt + c.doubt + 4 * REAL_EPSILON * (sum + 3 * p->radius));
  y.w = d > 256 * REAL_EPSILON ? error : -1;
  return y;
}

/* Moves vertex v to y and stores its error y.w in side[v]. Returns a bound for the distance of its former
   place from the true one. */
static inline real move_vertex(vertices_t* p, int v, real4 y) {
  const real x[3] = {y.x, y.y, y.z};
  real moved = y.w;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    moved += fabs(x[k] - p->x[k][v]);
    p->x[k][v] = x[k];
  }
  p->side[v] = y.w;
  return moved;
}

/* Whether vertex y with its error is inside the plane. */
static inline bool is_inside(const vertices_t* p, real4 y, real error, certain_plane_t plane) {
  const real s = plane.plane.x * y.x + plane.plane.y * y.y + plane.plane.z * y.z - plane.plane.w;
  return s < -(error + plane.doubt + 4 * REAL_EPSILON * (p->radius + fabs(plane.plane.w)));
}

/* Whether each vertex, with its own error (side[]), is inside the bisector of `closest`. */
static inline bool closest_is_clear(const vertices_t* p) {
  const certain_plane_t plane = unit_plane(p, raw_bisector(p, p->closest));
  bool clear = true;
  for (int w = 0; w < words_of(p); ++w)
    for (ulong bits = p->used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      clear = is_inside(p, vertex_point(p, v), p->side[v], plane) && clear;
    }
  return clear;
}

#endif
