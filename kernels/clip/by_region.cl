/* One work-item clips one (region, seed) pair, with candidates from the list of the region or, where that
   would be long, from the packed tree. */
#include "neighbors/search.cl"
#include "neighbors/region.cl"
#include "clip/write.cl"

/* Work-item t takes pair active[t] of the chunk and row t of the outputs; moments go by pair. */
__kernel void clip_by_region_kernel(
    const uint count, __global const uint* active, __global const uint* pair_seed,
    __global const uint* pair_region, __global const seed_t* corners, __global const uint* region_offset,
    __global const uint* region_vertex, __global const int* behind,
    __global const region_shape_t* shape, __global uint* status,
    __global stored_real* moments, __global uint* faces, __global int* border, __global stored_real* wall,
    __global uint* vertices, __global stored_real* vertex, __global uint* link,
    __global const ulong* list_offset, __global const uint* list_seed,
    __global const seed_t* seeds, const uint seed_count, __global const seed_t* node_low,
    __global const seed_t* node_high, __global const uint* level_offset, const int levels,
    __global const stored_real* seed_block, __global const stored_real* node_block,
    __global const uint* near, __global const uint* near_count, __global const stored_real* near_bound) {
  const uint row = (uint)get_global_id(0);
  if (row >= count) return;
  const uint pair = active[row], i = pair_seed[pair], region = pair_region[pair];
  const tree_t tree = {seeds, node_low, node_high, level_offset, levels, seed_count};
  const blocks_t blocks = {seed_block, node_block, near, near_count, near_bound};
  const region_lists_t lists = {seeds, list_offset, list_seed};
  const output_t out = {moments, faces, border, wall, vertices, vertex, link};
  cell_t cell;
  const regions_t regions = {corners, region_offset, region_vertex, behind, shape};
  int result = cell_start(&cell, regions, seeds, i, region);
  if (result == PIECE_WHOLE)
    result = region_has_list(lists, region) ? clip_by_region(&cell, lists, i, region) : clip_by_tree(&cell, tree, blocks, i);
  status[row] = (uint)write_piece(&cell, out, result, pair, row);
}
