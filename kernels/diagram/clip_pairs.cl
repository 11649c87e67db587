/* Clips (region, seed) pairs whose number only the device knows. */
#include "neighbors/search.cl"
#include "clip/write.cl"

/* Work-item t takes entry first + t of the pairs, or of `list` where `listed`, if it is below `end` and
   below their number: offset[seed_count] pairs, found[0] listed ones. Writes status and moments by
   pair. */
__kernel void clip_pairs(const uint first, const uint end, __global const ulong* offset, const int listed,
                         __global const uint* list, __global const uint* found,
                         __global const uint* pair_seed, __global const uint* pair_region,
                         __global const uint* state, __global const seed_t* corners,
                         __global const uint* region_offset, __global const uint* region_vertex,
                         __global const int* behind, __global const region_shape_t* shape,
                         __global uint* status,
                         __global stored_real* moments, __global const seed_t* seeds, const uint seed_count,
                         __global const seed_t* node_low, __global const seed_t* node_high,
                         __global const uint* level_offset, const int levels,
                         __global const stored_real* seed_block, __global const stored_real* node_block,
                         __global const uint* near, __global const uint* near_count,
                         __global const stored_real* near_bound) {
  const uint entry = first + (uint)get_global_id(0);
  if (entry >= end || entry >= (listed ? (ulong)found[0] : offset[seed_count])) return;
  const uint pair = listed ? list[entry] : entry, i = pair_seed[pair];
  const tree_t tree = {seeds, node_low, node_high, level_offset, levels, seed_count};
  const blocks_t blocks = {seed_block, node_block, near, near_count, near_bound};
  const output_t out = {moments, 0, 0, 0, 0, 0, 0};
  const regions_t regions = {corners, region_offset, region_vertex, behind, shape};
  cell_t cell;
  int result = state[i] == SEED_OK ? PIECE_WHOLE : PIECE_EMPTY;
  if (result == PIECE_WHOLE)
    result = cell_start(&cell, regions, seeds, i, pair_region[pair]);
  if (result == PIECE_WHOLE) result = clip_by_tree(&cell, tree, blocks, i);
  status[pair] = (uint)write_piece(&cell, out, result, pair, 0);
}
