/* Builds the packed tree (kernels/neighbors/tree.cl) over seeds in curve order, level by level. Its shape
   depends on the number of seeds only. */
#include "base/point.cl"

#define TREE_FAN 8u

/* level_offset[l]: nodes on the levels below l. */
__kernel void lay_out_levels(const uint seeds, __global uint* level_offset) {
  if (get_global_id(0) != 0) return;
  uint nodes = seeds, sum = 0, level = 0;
  level_offset[0] = 0;
  do {
    nodes = nodes / TREE_FAN + (nodes % TREE_FAN != 0 ? 1u : 0u);
    sum += nodes;
    level_offset[++level] = sum;
  } while (nodes > 1);
}

/* Extends the box [low, high] and the largest weight, kept in `low`, to hold those of the child. */
static inline void add_child(parts_t* low, parts_t* high, const parts_t* child_low,
                             const parts_t* child_high) {
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    if (parts_less(child_low, low, k)) {
      low->high[k] = child_low->high[k];
      low->low[k] = child_low->low[k];
    }
    if (parts_less(high, child_high, k)) {
      high->high[k] = child_high->high[k];
      high->low[k] = child_high->low[k];
    }
  }
  if (parts_less(low, child_low, 3)) {
    low->high[3] = child_low->high[3];
    low->low[3] = child_low->low[3];
  }
}

/* Node to + t holds the children 8t .. 8t+7 of `children`, which begin at `from` of child_low and
   child_high: seeds (both the same buffer) or nodes. An inactive child does not extend a box. */
__kernel void build_level(const uint nodes, const uint to, const uint children, const uint from,
                          __global const seed_t* child_low, __global const seed_t* child_high,
                          __global seed_t* node_low, __global seed_t* node_high) {
  const uint t = (uint)get_global_id(0);
  if (t >= nodes) return;
  const uint begin = t * TREE_FAN, end = begin + min(TREE_FAN, children - begin);
  parts_t low = parts_of(child_low[from + begin]), high = parts_of(child_high[from + begin]);
  for (uint k = begin + 1; k < end; ++k) {
    const parts_t child_lows = parts_of(child_low[from + k]), child_highs = parts_of(child_high[from + k]);
    if (is_dead(&child_lows)) continue;
    if (is_dead(&low)) {
      low = child_lows;
      high = child_highs;
    } else {
      add_child(&low, &high, &child_lows, &child_highs);
    }
  }
  high.high[3] = high.low[3] = 0; /* kept with the low corner only */
  node_low[to + t] = seed_of(low);
  node_high[to + t] = seed_of(high);
}
