/* One work-item clips one (region, seed) pair by the neighbours of the seed's whole cell: no other seed has a
   bisector that bounds it. For domains of many regions, where a cell is searched for once and not per piece. */
#include "neighbors/search.cl"
#include "clip/write.cl"

/* A cell of more walls than this is searched for in each region: few of them meet it. */
#define WALLS_MOST 64

/* Bit k is set if neighbour k of the first eight may cut the box of the cell. */
static inline uint walls_that_cut(const cell_t* cell, __global const seed_t* seeds, seed_t seed,
                                  __global const uint* neighbor, uint count) {
  real row[DIMENSION + 1][LANES], low[DIMENSION], high[DIMENSION], d[DIMENSION];
  real8 q[DIMENSION];
  for (uint lane = 0; lane < LANES; ++lane) {
    const seed_t other = seeds[neighbor[min(lane, count - 1)]];
    difference(other, seed, d);
    for (int k = 0; k < DIMENSION; ++k) row[k][lane] = d[k];
    row[DIMENSION][lane] = weight_difference(seed, other);
  }
  for (int k = 0; k < DIMENSION; ++k) q[k] = load8(row[k]);
  find_box(&cell->at, low, high);
  const uint bits = lane_bits(seeds_may_cut(q, load8(row[DIMENSION]), low, high));
  return count < LANES ? bits & ((1u << count) - 1) : bits;
}

/* Cuts by `count` neighbours. The seed alone in its own list has no cell. Returns a PIECE status. */
static inline int clip_by_walls(cell_t* cell, __global const seed_t* seeds, uint i, __global const uint* neighbor,
                                uint count) {
  const seed_t seed = seeds[i];
  if (count == 1 && neighbor[0] == i) return PIECE_EMPTY;
  for (uint first = 0; first < count; first += LANES) {
    uint bits = walls_that_cut(cell, seeds, seed, neighbor + first, count - first);
    for (; bits != 0; bits &= bits - 1) {
      const uint j = neighbor[first + (uint)lowest_bit(bits)];
      const int cut = cut_by_seed(cell, seed, seeds[j], (int)j);
      if (cut > CUT_SHRUNK) return piece_status(cut);
    }
  }
  return PIECE_WHOLE;
}

/* Arguments as of clip_by_tree_kernel, then the neighbours of rank i: neighbor[wall_offset[i]] and on. */
__kernel void clip_by_cell_kernel(
    const uint count, __global const uint* active, __global const uint* pair_seed,
    __global const uint* pair_region, __global const seed_t* corners, __global const uint* region_offset,
    __global const uint* region_vertex, __global const int* behind,
    __global const region_shape_t* shape, __global uint* status,
    __global stored_real* moments, __global uint* faces, __global int* border, __global stored_real* wall,
    __global uint* vertices, __global stored_real* vertex, __global uint* link,
    __global const seed_t* seeds, const uint seed_count, __global const seed_t* node_low,
    __global const seed_t* node_high, __global const uint* level_offset, const int levels,
    __global const stored_real* seed_block, __global const stored_real* node_block,
    __global const uint* near, __global const uint* near_count, __global const stored_real* near_bound,
    __global const uint* wall_offset, __global const uint* neighbor) {
  const uint row = (uint)get_global_id(0);
  if (row >= count) return;
  const uint pair = active[row], i = pair_seed[pair];
  const tree_t tree = {seeds, node_low, node_high, level_offset, levels, seed_count};
  const blocks_t blocks = {seed_block, node_block, near, near_count, near_bound};
  const output_t out = {moments, faces, border, wall, vertices, vertex, link};
  const uint first = wall_offset[i], walls = wall_offset[i + 1] - first;
  cell_t cell;
  const regions_t regions = {corners, region_offset, region_vertex, behind, shape};
  int result = cell_start(&cell, regions, seeds, i, pair_region[pair]);
  if (result == PIECE_WHOLE)
    result = walls > WALLS_MOST ? clip_by_tree(&cell, tree, blocks, i)
                                : clip_by_walls(&cell, seeds, i, neighbor + first, walls);
  status[row] = (uint)write_piece(&cell, out, result, pair, row);
}
