/* Clips a cell by all seeds that can cut it: first by those of the near leaves of its own leaf (near.cl),
   nearest bisector first; then, unless the bound of the near leaves proves that the cell is done
   (docs/mathematics.md (10b)), by the seeds of all nodes of the tree that (9) cannot exclude. Right for any
   weights: every seed that is left out is proved not to cut the cell. */
#ifndef POWERCELL_NEIGHBORS_SEARCH
#define POWERCELL_NEIGHBORS_SEARCH
#include "neighbors/order.cl"

/* After so many nodes, the next are tested by the vertices of the cell too. White noise visits some 20. */
#define VISITS_MOST 48

/* After so many nodes, or bisectors that cut nothing, a cell is left to the host: most seeds are about as far
   from one of its vertices, as those of a circle are from its centre, and boxes exclude few of them
   (docs/mathematics.md (86b)). One number counts both, since registers are scarce: nodes in the low 16 bits,
   misses above. The limits are single bits of it. */
#define VISITS_LIMIT 1024
#define ONE_MISS 65536u
#define MISSES_LIMIT ((DIMENSION == 2 ? 256 : 512) * ONE_MISS)
#ifndef LEAVES_TO_HOST
#define LEAVES_TO_HOST 1
#endif

/* Cells start no nearer than this: products of four lengths are in the range of numbers. */
#define LEAST_EXTENT ((real)1e-7)

/* A bound for the rounding of distances from the leaf's box, computed relative to its first seed. */
static inline real box_rounding(tree_t tree, uint leaf) {
  real low[DIMENSION], high[DIMENSION], extent = 0;
  difference(tree.node_low[leaf], tree.seeds[leaf * TREE_FAN], low);
  difference(tree.node_high[leaf], tree.seeds[leaf * TREE_FAN], high);
  UNROLL for (int k = 0; k < DIMENSION; ++k) extent += most_of(fabs(low[k]), fabs(high[k]));
  return 4 * REAL_EPSILON * extent;
}

/* True if no seed outside the near leaves can cut the cell: their distance from the home
   box against the radius of the cell (docs/mathematics.md (10b)). */
static inline bool near_is_enough(cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  const uint home = i / TREE_FAN;
  const seed_t seed = tree.seeds[i], first = tree.node_low[home];
  const real bound = blocks.near_bound[home];
  if (tree.levels == 1 || bound <= -REAL_MAX / 2) return bound > 0;
  const real heaviest = weight_difference(tree.node_low[tree.level_offset[tree.levels] - 1], first);
  const real lifted2 = bound + heaviest, own = bound + weight_difference(seed, first);
  if (!(lifted2 > 0 && own > 0)) return false;
  find_radius2(&cell->at);
  const real off = box_rounding(tree, home) + 4 * cell->at.blur.position;
  const real weights_off = 4 * (REAL_EPSILON * lifted2 + cell->at.blur.weight + blur_of(first).weight);
  return own * (1 - SEARCH_MARGIN / 8) - weights_off > 2 * sqrt(lifted2) * (cell->at.radius + off);
}

/* Tells which leaves are near, by their lifted distance. */
typedef struct {
  home_t home;
  real bound;
} near_t;

static inline near_t near_to(tree_t tree, blocks_t blocks, uint home) {
  near_t near;
  near.home = home_of(tree, blocks, home);
  near.bound = blocks.near_bound[home];
  return near;
}

static inline uint near_leaves(const near_t* near, tree_t tree, blocks_t blocks, uint node, uint lane) {
  reals a[DIMENSION], b[DIMENSION], dw;
  node_lanes(blocks, block_of_children(tree, node, 1), lane, &near->home.origin, a, b, &dw);
  return lane_bits(lifted_distances(&near->home, a, b, dw) < all_lanes(near->bound));
}

/* Pushes the children of a node that may cut the cell and are not near, nearest on top. Tested by the box of
   the cell, and if `close` by its vertices. */
static inline void push_children(stack_t* stack, tree_t tree, blocks_t blocks, uint node, int level,
                                 const near_t* near, const vertices_t* at, bool close) {
  const uint block = block_of_children(tree, node, level);
  const int base = stack->depth;
  const origin_t origin = search_origin(at->seeds[at->self]);
  EACH_LANE(lane) {
    reals a[DIMENSION], b[DIMENSION], dw;
    node_lanes(blocks, block, lane, &origin, a, b, &dw);
    uint bits = lane_bits(nodes_may_cut(at, a, b, dw));
    if (close && bits != 0) bits &= lane_bits(nodes_cut(at, a, b, dw));
    if (bits == 0) continue;
    reals distance = dw;
    UNROLL for (int k = 0; k < DIMENSION; ++k) {
      const reals gap = each_most(each_most(a[k], -b[k]), ZERO);
      distance = distance + gap * gap;
    }
    real key[LANE_WIDTH] FOR_LANES;
    store_lanes(distance, key);
    if (level == 1) bits &= ~near_leaves(near, tree, blocks, node, lane);
    for (; bits != 0; bits &= bits - 1) {
      const int k = lowest_bit(bits);
      push_sorted(stack, base, node * TREE_FAN + lane + (uint)k, level - 1, key[k]);
    }
  }
}

/* Cuts by all seeds outside the near leaves that may cut the cell. */
static inline int cut_by_rest(cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  stack_t stack;
  const near_t near = near_to(tree, blocks, i / TREE_FAN);
  find_box(&cell->at);
  push_root(&stack, tree);
  for (uint effort = 0; stack.depth > 0; ++effort) {
    const bool close = (effort & (ONE_MISS - 1)) >= VISITS_MOST;
    if (LEAVES_TO_HOST && (effort & (VISITS_LIMIT | MISSES_LIMIT)) != 0) return CUT_TANGLED;
    const uint node = stack.node[--stack.depth];
    const int level = stack.level[stack.depth];
    if (level > 0) {
      push_children(&stack, tree, blocks, node, level, &near, &cell->at, close);
      continue;
    }
    uint left = (1u << min(TREE_FAN, tree.count - node * TREE_FAN)) - 1;
    if (node == i / TREE_FAN) left &= ~(1u << i % TREE_FAN);
    const int cut = cut_by_leaf(cell, blocks, node, left, close);
    if (cut > CUT_SHRUNK) return cut;
    if (LEAVES_TO_HOST) effort += (uint)-cut * ONE_MISS;
  }
  return CUT_NONE;
}

/* Clips the cell of rank i, started as a region, by all other seeds. Returns a PIECE status. */
static inline int clip_by_all(cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  int cut = cut_by_near(cell, tree, blocks, i);
  if (cut > CUT_SHRUNK) return piece_status(cut);
  if (near_is_enough(cell, tree, blocks, i)) return PIECE_DONE;
  cut = cut_by_rest(cell, tree, blocks, i);
  return cut > CUT_SHRUNK ? piece_status(cut) : PIECE_DONE;
}

/* How far from the seed its cell may be expected to reach: as far as the leaf before its own, along each
   axis. That leaf is the same whatever images or other seeds follow in rank, and so are all bits of the cell.
 */
static inline real expected_extent(tree_t tree, uint i) {
  if (!START_NEAR || i < TREE_FAN) return REAL_MAX;
  const uint leaf = i / TREE_FAN - 1;
  real low[DIMENSION], high[DIMENSION], extent = LEAST_EXTENT;
  difference(tree.node_low[leaf], tree.seeds[i], low);
  difference(tree.node_high[leaf], tree.seeds[i], high);
  UNROLL for (int k = 0; k < DIMENSION; ++k) extent = most_of(extent, most_of(-low[k], high[k]));
  return extent;
}

/* Clips the cell of rank i in a region by all other seeds: first in the part of the region in which it is
   expected, so that rounding is relative to that, then, if it is not within it, in all of the region. Returns
   a PIECE status. */
static inline int clip_by_tree(cell_t* cell, regions_t regions, tree_t tree, blocks_t blocks, uint i,
                               uint region) {
  real extent = expected_extent(tree, i);
  for (;;) {
    int result = cell_start(cell, regions, tree.seeds, i, region, extent);
    if (result == PIECE_DONE) result = clip_by_all(cell, tree, blocks, i);
    if (result > PIECE_EMPTY || clears_extent(&cell->at)) return result;
    extent = REAL_MAX;
  }
}

#endif
