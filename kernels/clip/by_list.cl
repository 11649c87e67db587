/* One work-item clips one (region, seed) pair, with candidates from the seed's neighbour list. */
#include "clip/arguments.cl"
#include "neighbors/list.cl"

/* Work-item t takes pair active[t] of the chunk, neighbour row active_list[t] and row t of the
   outputs; moments go by pair. With OUTPUT_LIST_USE row t of list_use is: neighbours tried, cuts, and 1 if
   the list sufficed. */
__kernel void clip_by_list_kernel(PIECE_ARGUMENTS, __global const seed_t* seeds, const uint seed_count,
                                  __global const stored_real* lift, __global const uint* neighbor,
                                  __global const uint* active_list, const uint stride, const uint list_count,
                                  const int twins, __global uint* list_use) {
  const uint row = (uint)get_global_id(0);
  if (row >= count) return;
  const uint pair = active[row], i = pair_seed[pair];
  const lists_t lists = {seeds, lift, neighbor, stride, list_count, seed_count, twins};
  const output_t out = OUTPUT_OF_ARGUMENTS;
  cell_t cell;
  const regions_t regions = REGIONS_OF_ARGUMENTS;
  int result = cell_start(&cell, regions, seeds, i, pair_region[pair], REAL_MAX);
  list_use_t use = {0, 0};
  if (result == PIECE_DONE) result = clip_by_list(&cell, lists, i, active_list[row], &use);
  status[row] = (uint)write_piece(&cell, out, result, pair, row);
  if (outputs & OUTPUT_LIST_USE) {
    list_use[3 * row] = use.tried;
    list_use[3 * row + 1] = use.cuts;
    list_use[3 * row + 2] = result == PIECE_DONE || result == PIECE_EMPTY;
  }
}
