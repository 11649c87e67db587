/* Computes the place of a grid cell along the Hilbert curve from the entry corner and direction of each level
   (Hamilton and Rau-Chaplin, "Compact Hilbert indices", 2008, section 2); the same curve as
   lib/seeds/hilbert.hpp. */
#ifndef POWERCELL_SEEDS_HILBERT
#define POWERCELL_SEEDS_HILBERT
#include "base/real.cl"

#define HILBERT_BITS (DIMENSION == 2 ? 31 : 21)
#define HILBERT_MASK ((1u << DIMENSION) - 1u)

static inline uint rotate_left(uint v, uint by) {
  by %= DIMENSION;
  return ((v << by) | (v >> (DIMENSION - by))) & HILBERT_MASK;
}

static inline uint gray_code(uint w) {
  return w ^ (w >> 1);
}

/* The number of trailing ones of w modulo DIMENSION. */
static inline uint trailing_ones(uint w) {
  uint ones = 0;
  while (ones < DIMENSION && ((w >> ones) & 1u) != 0) ++ones;
  return ones % DIMENSION;
}

static inline ulong hilbert_key(const uint* cell) {
  ulong key = 0;
  uint entry = 0, axis = 0;
  for (int bit = HILBERT_BITS - 1; bit >= 0; --bit) {
    uint child = 0;
    UNROLL for (int k = 0; k < DIMENSION; ++k) child |= ((cell[k] >> bit) & 1u) << k;
    const uint code = rotate_left(child ^ entry, (uint)DIMENSION - (axis + 1u) % DIMENSION);
    uint w = code;
    for (uint shift = 1; shift < DIMENSION; ++shift) w ^= code >> shift;
    key = (key << DIMENSION) | w;
    const uint start = w == 0 ? 0 : gray_code((w - 1u) & ~1u);
    const uint along = w == 0 ? 0 : trailing_ones((w & 1u) != 0 ? w : w - 1u);
    entry ^= rotate_left(start, axis + 1u);
    axis = (axis + along + 1u) % DIMENSION;
  }
  return key;
}

#endif
