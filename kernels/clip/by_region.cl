/* One work-item clips one (region, seed) pair, with candidates from the list of the region or, where that
   would be long, from the packed tree. */
#include "clip/arguments.cl"
#include "neighbors/region.cl"
#include "neighbors/search.cl"

__kernel void clip_by_region_kernel(PIECE_ARGUMENTS, __global const ulong* list_offset,
                                    __global const uint* list_seed, TREE_ARGUMENTS) {
  const uint row = (uint)get_global_id(0);
  if (row >= count) return;
  const uint pair = active[row], i = pair_seed[pair], region = pair_region[pair];
  const tree_t tree = TREE_OF_ARGUMENTS;
  const blocks_t blocks = BLOCKS_OF_ARGUMENTS;
  const region_lists_t lists = {seeds, list_offset, list_seed};
  const output_t out = OUTPUT_OF_ARGUMENTS;
  cell_t cell;
  const regions_t regions = REGIONS_OF_ARGUMENTS;
  const int result = region_has_list(lists, region) ? clip_by_region(&cell, regions, lists, i, region)
                                                    : clip_by_tree(&cell, regions, tree, blocks, i, region);
  status[row] = (uint)write_piece(&cell, out, result, pair, row);
}
