/* Stream compaction: lists the indices of the entries of an array that have a given value. */

/* places[k] = 1 where values[k] is `wanted`, else 0; places[count] = 0. */
__kernel void mark_wanted(const uint count, __global const uint* values, const uint wanted,
                          __global uint* places) {
  const uint k = (uint)get_global_id(0);
  if (k > count) return;
  places[k] = k < count && values[k] == wanted ? 1u : 0u;
}

/* From the exclusive prefix sums of the marks: writes the indices of the marked entries, ascending, as far as
   there is room, and their number to found[0]. */
__kernel void list_marked(const uint count, __global const uint* places, const uint room,
                          __global uint* indices, __global uint* found) {
  const uint k = (uint)get_global_id(0);
  if (k > count) return;
  const uint at = places[k];
  if (k == count)
    found[0] = at;
  else if (places[k + 1] != at && at < room)
    indices[at] = k;
}
