/* One work-item clips one (region, seed) pair, with candidates from the seed's neighbour list. */
#include "neighbors/list.cl"
#include "clip/write.cl"

/* Work-item t takes pair active[t] of the chunk, neighbour row active_list[t] and row t of the
   outputs; moments go by pair. With OUTPUT_LIST_USE row t of list_use is: neighbours tried, cuts, and 1 if
   the list sufficed. */
__kernel void clip_by_list_kernel(
    const uint count, __global const uint* active, __global const uint* pair_seed,
    __global const uint* pair_region, __global const seed_t* corners, __global const uint* region_offset,
    __global const uint* region_vertex, __global const int* behind,
    __global const region_shape_t* shape, __global uint* status,
    __global stored_real* moments, __global uint* faces, __global int* border, __global stored_real* wall,
    __global uint* vertices, __global stored_real* vertex, __global uint* link,
    __global const seed_t* seeds, const uint seed_count, __global const stored_real* lift,
    __global const uint* neighbor, __global const uint* active_list, const uint stride,
    const uint list_count, const int twins, __global uint* list_use) {
  const uint row = (uint)get_global_id(0);
  if (row >= count) return;
  const uint pair = active[row], i = pair_seed[pair];
  const lists_t lists = {seeds, lift, neighbor, stride, list_count, seed_count, twins};
  const output_t out = {moments, faces, border, wall, vertices, vertex, link};
  cell_t cell;
  const regions_t regions = {corners, region_offset, region_vertex, behind, shape};
  int result = cell_start(&cell, regions, seeds, i, pair_region[pair]);
  list_use_t use = {0, 0};
  if (result == PIECE_WHOLE) result = clip_by_list(&cell, lists, i, active_list[row], &use);
  status[row] = (uint)write_piece(&cell, out, result, pair, row);
  if (OUTPUTS & OUTPUT_LIST_USE) {
    list_use[3 * row] = use.tried;
    list_use[3 * row + 1] = use.cuts;
    list_use[3 * row + 2] = result == PIECE_WHOLE || result == PIECE_EMPTY;
  }
}
