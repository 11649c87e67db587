/* Chooses how far images are made, as first_margin of lib/periodic/images.cpp does. */
#include "base/point.cl"

#define TILE_COUNT 0
#define TILE_SUM 1
#define TILE_MOST 2
#define TILE_SIZE 3

/* Of the seeds by rank in tile t that may have cells: their number, the sum of the weights and the largest.
 */
__kernel void weights_of_tiles(const uint tiles, const uint tile, const uint count,
                               __global const seed_t* points, __global const uint* state,
                               __global stored_real* of_tile) {
  const uint t = (uint)get_global_id(0);
  if (t >= tiles) return;
  const uint begin = t * tile, end = begin + min(tile, count - begin);
  real number = 0, sum = 0, most = -REAL_MAX;
  for (uint i = begin; i < end; ++i) {
    if (state[i] != SEED_OK) continue;
    const parts_t p = parts_of(points[i]);
    number += 1;
    sum += p.high[3];
    most = fmax(most, p.high[3]);
  }
  of_tile[(size_t)t * TILE_SIZE + TILE_COUNT] = number;
  of_tile[(size_t)t * TILE_SIZE + TILE_SUM] = sum;
  of_tile[(size_t)t * TILE_SIZE + TILE_MOST] = most;
}

/* Writes MARGIN_... of layout.h. The margin is what (34b) needs for the largest cells of white noise: the
   volume, in those of a mean cell, of the largest ball without seeds is about the logarithm of their number.
 */
__kernel void find_margin(const uint tiles, __global const stored_real* of_tile,
                          __global const stored_real* extent, __global stored_real* margin) {
  if (get_global_id(0) != 0) return;
  real number = 0, sum = 0, most = -REAL_MAX;
  for (uint t = 0; t < tiles; ++t) {
    number += of_tile[(size_t)t * TILE_SIZE + TILE_COUNT];
    sum += of_tile[(size_t)t * TILE_SIZE + TILE_SUM];
    most = fmax(most, (real)of_tile[(size_t)t * TILE_SIZE + TILE_MOST]);
  }
  margin[MARGIN_WEIGHT] = most;
  margin[MARGIN_WIDTH] = 0;
  if (!(number > 0)) return;
  const real mean_cell = extent[EXTENT_MEASURE] / number, ball = log(number) + 6;
  const real reach =
      DIMENSION == 2 ? sqrt(mean_cell * ball / (real)3.14) : cbrt(mean_cell * ball / (real)4.19);
  const real square = reach * reach, excess = (real)1.5 * (most - sum / number);
  margin[MARGIN_WIDTH] = reach + sqrt(square + fmin(fmax(excess, (real)0), 2 * square));
}
