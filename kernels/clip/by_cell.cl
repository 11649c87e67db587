/* One work-item clips one (region, seed) pair by the neighbours of the seed's whole cell: no other seed has a
   bisector that bounds it. For domains of many regions, where a cell is searched for once and not per piece.
   Cells without neighbours here have not been clipped yet, and are searched for. */
#include "clip/arguments.cl"
#include "neighbors/search.cl"

/* A cell of more walls than this is searched for in each region: few of them meet it. */
#define WALLS_MOST 64

/* Bit k is set if neighbour k of the first LANE_WIDTH may cut the box of the cell. */
static inline uint walls_that_cut(const cell_t* cell, __global const seed_t* seeds, seed_t seed,
                                  __global const uint* neighbor, uint count) {
  real row[DIMENSION + 1][LANE_WIDTH] FOR_LANES, d[DIMENSION];
  reals q[DIMENSION];
  for (uint lane = 0; lane < LANE_WIDTH; ++lane) {
    const seed_t other = seeds[neighbor[min(lane, count - 1)]];
    difference(other, seed, d);
    UNROLL for (int k = 0; k < DIMENSION; ++k) row[k][lane] = d[k];
    row[DIMENSION][lane] = weight_difference(seed, other) - 4 * cell->at.blur.weight;
  }
  UNROLL for (int k = 0; k < DIMENSION; ++k) q[k] = load_lanes(row[k]);
  const uint bits = lane_bits(seeds_may_cut(&cell->at, q, load_lanes(row[DIMENSION])));
  return count < LANE_WIDTH ? bits & ((1u << count) - 1) : bits;
}

/* Clips by `count` neighbours. The seed alone in its own list has no cell. Returns a PIECE status. */
static inline int clip_by_walls(cell_t* cell, regions_t regions, __global const seed_t* seeds, uint i,
                                uint region, __global const uint* neighbor, uint count) {
  const seed_t seed = seeds[i];
  const int start = cell_start(cell, regions, seeds, i, region, REAL_MAX);
  if (start != PIECE_DONE) return start;
  if (count == 1 && neighbor[0] == i) return PIECE_EMPTY;
  bool shrunk = true; /* since the box was found */
  for (uint first = 0; first < count; first += LANE_WIDTH) {
    if (shrunk) find_box(&cell->at);
    shrunk = false;
    uint bits = walls_that_cut(cell, seeds, seed, neighbor + first, count - first);
    for (; bits != 0; bits &= bits - 1) {
      const uint j = neighbor[first + (uint)lowest_bit(bits)];
      const int cut = cut_by_seed(cell, (int)j);
      if (cut > CUT_SHRUNK) return piece_status(cut);
      shrunk = shrunk || cut == CUT_SHRUNK;
    }
  }
  return PIECE_DONE;
}

/* The neighbours of rank i are neighbor[wall_offset[i]] and on; none if the cell has not been clipped. */
__kernel void clip_by_cell_kernel(PIECE_ARGUMENTS, TREE_ARGUMENTS, __global const uint* wall_offset,
                                  __global const uint* neighbor) {
  const uint row = (uint)get_global_id(0);
  if (row >= count) return;
  const uint pair = active[row], i = pair_seed[pair];
  const tree_t tree = TREE_OF_ARGUMENTS;
  const blocks_t blocks = BLOCKS_OF_ARGUMENTS;
  const output_t out = OUTPUT_OF_ARGUMENTS;
  const uint first = wall_offset[i], walls = wall_offset[i + 1] - first;
  cell_t cell;
  const regions_t regions = REGIONS_OF_ARGUMENTS;
  const int result =
      walls == 0 || walls > WALLS_MOST
          ? clip_by_tree(&cell, regions, tree, blocks, i, pair_region[pair])
          : clip_by_walls(&cell, regions, seeds, i, pair_region[pair], neighbor + first, walls);
  status[row] = (uint)write_piece(&cell, out, result, pair, row);
}
