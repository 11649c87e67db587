/* Clips (region, seed) pairs whose number only the device knows. */
#define LEAVES_TO_HOST 0 /* the caller may not want a host to follow */
#include "clip/arguments.cl"
#include "neighbors/search.cl"

#if WITH_DENSITY
#define DENSITY_ARGUMENTS __global const stored_real *density, __global stored_real *density_moments,
#define DENSITY_IN(region) , density + (size_t)DENSITY_SIZE*(region), density_moments
#else
#define DENSITY_ARGUMENTS
#define DENSITY_IN(region)
#endif

/* The faces of pieces, in any order of the pieces: used[0] entries are taken. */
typedef struct {
  uint faces;    /* a sum of FACES_...; 0 where none are wanted */
  uint capacity; /* entries. Beyond it pieces count as those that do not fit */
  volatile __global uint* used;
  __global uint *first, *size; /* of each pair */
  __global int* border;
  __global stored_real* wall;
} wall_store_t;

/* Adds those faces of a clipped cell; returns whether there was room. Where they are does not change results:
   rows are gathered by pair. */
static inline bool store_walls(cell_t* cell, wall_store_t store, uint faces, uint pair) {
  const uint count = (uint)cell_write_walls(cell, faces, 0, 0);
  store.size[pair] = 0;
  if (count == 0) return true;
  /* Read first, so that the number of pieces without room cannot bring it beyond what it can count to. */
  const uint first = *store.used <= store.capacity ? atomic_add(store.used, count) : store.capacity;
  if (count > store.capacity || first > store.capacity - count) return false;
  cell_write_walls(cell, faces, store.border + first, store.wall + first);
  store.first[pair] = first;
  store.size[pair] = count;
  return true;
}

/* Work-item t takes entry first + t of the pairs, or of `list` where `listed`, if it is below `end` and
   below their number: offset[count] pairs of the first `count` seeds, found[0] listed ones. Writes status and
   moments by pair, those of `faces` (a sum of FACES_...), and the reach of cells where `with_reach`. With a
   density (diagram/clip_density.cl) its moments too. */
__kernel void clip_pairs(const uint first, const uint end, const uint count, const int with_reach,
                         __global const ulong* offset, const int listed, __global const uint* list,
                         __global const uint* found, __global const uint* pair_seed,
                         __global const uint* pair_region, __global const uint* state,
                         __global const seed_t* corners, __global const uint* region_offset,
                         __global const uint* region_vertex, __global const int* behind,
                         __global const region_shape_t* shape, __global uint* status,
                         __global stored_real* moments, __global stored_real* reach, const uint faces,
                         const uint wall_capacity, volatile __global uint* used, __global uint* piece_first,
                         __global uint* piece_size, __global int* border, __global stored_real* wall,
                         DENSITY_ARGUMENTS TREE_ARGUMENTS) {
  const uint entry = first + (uint)get_global_id(0);
  if (entry >= end || entry >= (listed ? (ulong)found[0] : offset[count])) return;
  const uint pair = listed ? list[entry] : entry, i = pair_seed[pair];
  const tree_t tree = TREE_OF_ARGUMENTS;
  const blocks_t blocks = BLOCKS_OF_ARGUMENTS;
  const wall_store_t store = {faces, wall_capacity, used, piece_first, piece_size, border, wall};
  const output_t out = {OUTPUT_MOMENTS | (faces != 0 ? OUTPUT_SIDES : 0) | (with_reach ? OUTPUT_REACH : 0),
                        moments,
                        0,
                        0,
                        0,
                        0,
                        0,
                        0,
                        reach DENSITY_IN(pair_region[pair])};
  const regions_t regions = REGIONS_OF_ARGUMENTS;
  cell_t cell;
  int result = PIECE_EMPTY;
  if (state[i] == SEED_OK)
    result = clip_by_tree(&cell, regions, tree, blocks, i, pair_region[pair]);
  else
    cell.at.gap = 1; /* not even started, and certainly empty */
  result = write_piece(&cell, out, result, pair, pair);
  if (faces != 0) {
    const int piece = result & ~PIECE_UNCERTAIN;
    if (piece != PIECE_DONE && piece != PIECE_FLAT)
      piece_size[pair] = 0;
    else if (!store_walls(&cell, store, piece == PIECE_DONE ? faces : faces & FACES_WALLS, pair))
      result = PIECE_FULL; /* a flat piece has its facets on both sides */
  }
  status[pair] = (uint)result;
}
