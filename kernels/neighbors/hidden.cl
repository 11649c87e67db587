/* Finds seeds without a cell in a box, without clipping: DIMENSION + 1 other seeds together prove that no
   point of the box is the seed's (docs/mathematics.md (10c)). The simplex method finds them among the seeds
   nearby (10d). */
#include "neighbors/nearest.cl"

/* Leaves whose seeds are rivals. Of 48 and 52 hidden seeds among 100 (white, W2) 4, 6 and 8 leaves find 34,
   44 and 47 in the plane, 8, 12 and 16 find 35, 44 and 48 in space. */
#define RIVAL_LEAVES (DIMENSION == 3 ? 12 : 6)
#define RIVALS (RIVAL_LEAVES * LANES)
#define ROWS (DIMENSION + 1)
/* Steps after which clipping decides about a seed: most hidden ones need 4 to 8. */
#define PIVOTS_MOST 12
/* Distance of the planes of the first basis from the seed, in units of the farthest rival's distance over the
   length of their normals before scaling (start_basis). Nearer planes save steps, but planes that are too
   near make hidden seeds go unnoticed. */
#define START_RADIUS ((real)1)

/* The seeds of some leaves near a seed p_i: q_j = p_j - p_i and offset_j = |q_j|^2 + w_i - w_j, so that no
   point p_i + y with q_j.(2y) > offset_j is i's. */
typedef struct {
  real q[DIMENSION][RIVALS] FOR_LANES;
  real offset[RIVALS] FOR_LANES;
  real extent; /* no q_j is longer */
  int leaves;
} rivals_t;

/* A basis: ROWS columns (q_k, 1), of rivals or of planes of a simplex around the seed, whose multiples e_k
   sum up to (0, 1). Of its inverse columns are kept, one number for each k, the last of which is e; unused
   numbers are 0. */
typedef struct {
  real inverse[ROWS][4];
  real q[ROWS][DIMENSION];
  real offset[ROWS];
  real proof[ROWS]; /* the same of a rival; of a plane of the simplex the least offset that all of the box is
                       within */
  real dual[ROWS];  /* (2y, t): the point y at which all of the basis have the same value offset - q.(2y), and
                       that */
} basis_t;

/* The box relative to p_i, and the errors of the data there. */
typedef struct {
  real low[DIMENSION], high[DIMENSION];
  real size; /* largest sum of coordinates */
  blur_t blur;
} room_t;

static inline room_t room_of(seed_t seed, __global const seed_t* box) {
  room_t room;
  difference(box[0], seed, room.low);
  difference(box[1], seed, room.high);
  room.size = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) room.size += most_of(fabs(room.low[k]), fabs(room.high[k]));
  room.blur = blur_of(seed);
  return room;
}

/* A bound for the error of 2 q.y - offset over the box, like plane_error of cell/certain.cl. */
static inline real rival_error(const room_t* room, const real* q, real offset) {
  real sum = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) sum += fabs(q[k]);
  return REAL_EPSILON * (8 * sum * room->size + 8 * norm2(q) + 4 * fabs(offset)) +
         plane_blur(room->blur, room->size, sum);
}

/* Reads the seeds of the leaves; returns whether p_i itself is beyond the bisector of any. */
static inline bool find_rivals(rivals_t* rivals, blocks_t blocks, const nearest_t* near, seed_t seed,
                               uint i) {
  const origin_t origin = origin_of(seed);
  reals least = ZERO, most = ZERO;
  rivals->leaves = near->count;
  for (int k = 0; k < near->count; ++k) {
    EACH_LANE(lane) {
      const uint at = (uint)k * LANES + lane;
      reals q[DIMENSION], dw, offset;
      seed_lanes(blocks, near->leaf[k], lane, &origin, q, &dw);
      offset = ZERO;
      UNROLL for (int c = 0; c < DIMENSION; ++c) offset = offset + q[c] * q[c];
      most = each_most(most, offset);
      offset = offset + dw;
      if (near->leaf[k] == i / TREE_FAN) offset = with_lane(offset, i % TREE_FAN - lane, REAL_MAX / 4);
      UNROLL for (int c = 0; c < DIMENSION; ++c) store_lanes(q[c], rivals->q[c] + at);
      store_lanes(offset, rivals->offset + at);
      least = each_least(least, offset);
    }
  }
  rivals->extent = sqrt(lane_most(most));
  return lane_least(least) < 0;
}

/* Starts from the planes of a simplex around the seed, with normals scaled by `size`. */
static inline void start_basis(basis_t* basis, const room_t* room, real size) {
#if DIMENSION == 3
  const real4 normal[DIMENSION] = {make_real4(1, 1, -1, -1), make_real4(1, -1, 1, -1),
                                   make_real4(1, -1, -1, 1)};
  const real4 share = make_real4(1, 1, 1, 1) / 4;
  const real part = 1 / (4 * size);
#else
  const real h = (real)0.86602540378443864676;
  const real4 normal[DIMENSION] = {make_real4(1, (real)-0.5, (real)-0.5, 0), make_real4(0, h, -h, 0)};
  const real4 share = make_real4(1, 1, 1, 0) / 3;
  const real part = 2 / (3 * size);
#endif
  real n[DIMENSION][4];
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    store4(normal[k] * size, n[k]);
    store4(normal[k] * part, basis->inverse[k]);
  }
  store4(share, basis->inverse[DIMENSION]);
  UNROLL for (int r = 0; r < ROWS; ++r) {
    basis->offset[r] = START_RADIUS * 2 * size * size;
    basis->proof[r] = 0;
    UNROLL for (int k = 0; k < DIMENSION; ++k) {
      basis->q[r][k] = n[k][r];
      basis->proof[r] += 2 * most_of(n[k][r] * room->low[k], n[k][r] * room->high[k]);
    }
  }
  UNROLL for (int k = 0; k < DIMENSION; ++k) basis->dual[k] = 0;
  basis->dual[DIMENSION] = START_RADIUS * 2 * size * size;
}

/* The rival whose value offset - q.(2y) is least at the current point y. If the value is below 0, y is the
   rival's and not the seed's. */
static inline int worst_rival(const rivals_t* rivals, const basis_t* basis, real* value) {
  reals worst = all_lanes(REAL_MAX / 4);
  for (int k = 0; k < rivals->leaves * LANES; k += LANE_WIDTH) {
    reals left = load_lanes(rivals->offset + k);
    UNROLL for (int c = 0; c < DIMENSION; ++c) left =
        left - load_lanes(rivals->q[c] + k) * all_lanes(basis->dual[c]);
    worst = each_least(worst, tag(left, (uint)k));
  }
  const real least = lane_least(worst);
  *value = untagged(least);
  return (int)tag_of(least);
}

/* The basis column to replace by a new one so that all multiples stay at least 0, or -1 if there is none. The
   new column is the sum of `column` times the present ones; `inverse` is 1 / column. */
static inline int leaving_column(const real* multiple, real4 column, real4 inverse) {
  const real4 most = (real4)(REAL_MAX), least = (real4)(16 * REAL_EPSILON);
  real ratio[4];
  store4(select(most, vload4(0, multiple) * inverse, column > least), ratio);
  const int a = ratio[1] < ratio[0] ? 1 : 0, b = ratio[3] < ratio[2] ? 3 : 2;
  const int leaving = ratio[b] < ratio[a] ? b : a;
  return ratio[leaving] < REAL_MAX ? leaving : -1;
}

/* Puts `rival` into the basis; `excess` is its value minus t. Returns false if no column can leave. */
static inline bool enter_basis(basis_t* basis, const rivals_t* rivals, int rival, real excess) {
  real q[DIMENSION], u[4];
  real4 column = vload4(0, basis->inverse[DIMENSION]);
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    q[k] = rivals->q[k][rival];
    column = column + vload4(0, basis->inverse[k]) * q[k];
  }
  const real4 inverse = (real4)(1) / column;
  const int leaving = leaving_column(basis->inverse[DIMENSION], column, inverse);
  if (leaving < 0) return false;
  store4(inverse, u);
  const real scale = u[leaving];
  const real4 rest =
      (column - select((real4)(0), (real4)(1), (mask4)(0, 1, 2, 3) == (mask4)(leaving))) * scale;
  UNROLL for (int k = 0; k < ROWS; ++k) {
    const real old = basis->inverse[k][leaving];
    store4(vload4(0, basis->inverse[k]) - rest * old, basis->inverse[k]);
    basis->dual[k] += excess * old * scale;
  }
  UNROLL for (int k = 0; k < DIMENSION; ++k) basis->q[leaving][k] = q[k];
  basis->offset[leaving] = basis->proof[leaving] = rivals->offset[rival];
  return true;
}

/* Whether the basis proves that no point of the box is i's: a sum of its inequalities with multiples that
   are not negative holds nowhere in the box, errors included (docs/mathematics.md (10c)). */
static inline bool basis_proves(const basis_t* basis, const room_t* room) {
  real sum = 0, error = 0, q[DIMENSION];
  UNROLL for (int k = 0; k < DIMENSION; ++k) q[k] = 0;
  UNROLL for (int r = 0; r < ROWS; ++r) {
    const real e = most_of(basis->inverse[DIMENSION][r], 0);
    sum += e * basis->proof[r];
    error += e * rival_error(room, basis->q[r], basis->proof[r]);
    UNROLL for (int k = 0; k < DIMENSION; ++k) q[k] += e * basis->q[r][k];
  }
  UNROLL for (int k = 0; k < DIMENSION; ++k) sum -= 2 * least_of(q[k] * room->low[k], q[k] * room->high[k]);
  return sum < -2 * error;
}

/* Whether it is certain that the seed of rank i has no cell in the box. */
static inline bool is_hidden(tree_t tree, blocks_t blocks, __global const seed_t* box, const nearest_t* near,
                             uint i) {
  rivals_t rivals;
  const seed_t seed = tree.seeds[i];
  if (!find_rivals(&rivals, blocks, near, seed, i)) return false;
  const room_t room = room_of(seed, box);
  basis_t basis;
  start_basis(&basis, &room, rivals.extent);
  for (int pivots = 0; pivots < PIVOTS_MOST; ++pivots) {
    real value;
    const int rival = worst_rival(&rivals, &basis, &value);
    const real excess = value - basis.dual[DIMENSION];
    if (value > 0 || !(excess < 0) || !enter_basis(&basis, &rivals, rival, excess)) return false;
    if (basis.dual[DIMENSION] < 0 && basis_proves(&basis, &room)) return true;
  }
  return false;
}

/* Work-item t sets hidden[8t + k] to 1 if seed k of leaf t * stride certainly has no cell in the box from
   box[0] to box[1], else to 0. The tree must have more than one leaf. */
__kernel void find_hidden(const uint count, const uint stride, __global const seed_t* box,
                          __global const seed_t* seeds, const uint seed_count,
                          __global const seed_t* node_low, __global const seed_t* node_high,
                          __global const uint* level_offset, const int levels,
                          __global const stored_real* seed_block, __global const stored_real* node_block,
                          __global uchar* hidden) {
  const uint t = (uint)get_global_id(0);
  if (t >= count) return;
  const tree_t tree = {seeds, node_low, node_high, level_offset, levels, seed_count};
  const blocks_t blocks = {seed_block, node_block, 0, 0, 0};
  nearest_t near = nothing_near(RIVAL_LEAVES);
  find_nearest_leaves(&near, tree, blocks, t * stride);
  for (uint lane = 0; lane < TREE_FAN; ++lane) {
    const uint i = t * stride * TREE_FAN + lane;
    hidden[t * TREE_FAN + lane] = i < seed_count && is_hidden(tree, blocks, box, &near, i) ? 1 : 0;
  }
}
