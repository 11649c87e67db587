/* One work-item clips one (region, seed) pair, with candidates from the packed tree. */
#include "clip/arguments.cl"
#include "neighbors/search.cl"

__kernel void clip_by_tree_kernel(PIECE_ARGUMENTS, TREE_ARGUMENTS) {
  const uint row = (uint)get_global_id(0);
  if (row >= count) return;
  const uint pair = active[row];
  if (pair == NO_PAIR) return;
  const uint i = pair_seed[pair];
  const tree_t tree = TREE_OF_ARGUMENTS;
  const blocks_t blocks = BLOCKS_OF_ARGUMENTS;
  const output_t out = OUTPUT_OF_ARGUMENTS;
  cell_t cell;
  const regions_t regions = REGIONS_OF_ARGUMENTS;
  const int result = clip_by_tree(&cell, regions, tree, blocks, i, pair_region[pair]);
  status[row] = (uint)write_piece(&cell, out, result, pair, row);
}
