/* Clips (region, seed) pairs whose number only the device knows. */
#include "clip/arguments.cl"
#include "neighbors/search.cl"

/* Work-item t takes entry first + t of the pairs, or of `list` where `listed`, if it is below `end` and
   below their number: offset[seed_count] pairs, found[0] listed ones. Writes status and moments by
   pair. */
__kernel void clip_pairs(const uint first, const uint end, __global const ulong* offset, const int listed,
                         __global const uint* list, __global const uint* found,
                         __global const uint* pair_seed, __global const uint* pair_region,
                         __global const uint* state, __global const seed_t* corners,
                         __global const uint* region_offset, __global const uint* region_vertex,
                         __global const int* behind, __global const region_shape_t* shape,
                         __global uint* status, __global stored_real* moments, TREE_ARGUMENTS) {
  const uint entry = first + (uint)get_global_id(0);
  if (entry >= end || entry >= (listed ? (ulong)found[0] : offset[seed_count])) return;
  const uint pair = listed ? list[entry] : entry, i = pair_seed[pair];
  const tree_t tree = TREE_OF_ARGUMENTS;
  const blocks_t blocks = BLOCKS_OF_ARGUMENTS;
  const output_t out = {OUTPUT_MOMENTS, moments, 0, 0, 0, 0, 0, 0, 0};
  const regions_t regions = REGIONS_OF_ARGUMENTS;
  cell_t cell;
  int result = PIECE_EMPTY;
  if (state[i] == SEED_OK)
    result = clip_by_tree(&cell, regions, tree, blocks, i, pair_region[pair]);
  else
    cell.at.gap = 1; /* not even started, and certainly empty */
  status[pair] = (uint)write_piece(&cell, out, result, pair, 0);
}
