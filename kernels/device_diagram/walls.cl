/* The walls of all cells as compressed sparse rows, from those that clip_pairs.cl stored piece by piece. Rows
   in the store go by the seeds' place in the input: row i has the entries row_first[i] .. row_first[i] +
   row_size[i]. In a periodic domain each entry has besides the number of the image of the neighbour
   (kernels/periodic), minus that of the opposite one; without images these are not used. The parts of the
   domain's boundary that a cell has are at the end of its row: facets with ENTRY_FACET added. */
#include "base/real.cl"

#define NO_ENTRY 0xffffffffu

/* The entries of a row, or of all rows. */
typedef struct {
  __global uint* neighbor;
  __global stored_real* wall;
  __global int* image;
  int images; /* whether `image` is used */
} row_t;

/* Whether entry k comes before the wall with image s of neighbour j. */
static inline bool entry_is_before(row_t row, uint k, uint j, int s) {
  if (row.neighbor[k] != j || !row.images) return row.neighbor[k] < j;
  return row.image[k] < s;
}

static inline bool entry_is(row_t row, uint k, uint j, int s) {
  return row.neighbor[k] == j && (!row.images || row.image[k] == s);
}

static inline void set_entry(row_t row, uint k, uint j, int s, real measure) {
  row.neighbor[k] = j;
  row.wall[k] = measure;
  if (row.images) row.image[k] = s;
}

/* Adds a wall to a row of `size` entries in ascending order, or its measure to the wall with that image of
   the neighbour. Returns the new size. */
static inline uint add_to_row(row_t row, uint size, uint j, int s, real measure) {
  uint at = size;
  while (at > 0 && !entry_is_before(row, at - 1, j, s)) --at;
  if (at < size && entry_is(row, at, j, s)) {
    row.wall[at] += measure;
    return size;
  }
  for (uint k = size; k > at; --k)
    set_entry(row, k, row.neighbor[k - 1], row.images ? row.image[k - 1] : 0, row.wall[k - 1]);
  set_entry(row, at, j, s, measure);
  return size + 1;
}

/* The entry of image s of neighbour j in a row in ascending order, or NO_ENTRY. */
static inline uint find_in_row(row_t rows, uint first, uint size, uint j, int s) {
  uint low = 0, high = size;
  while (low < high) {
    const uint middle = (low + high) / 2;
    if (entry_is_before(rows, first + middle, j, s))
      low = middle + 1;
    else
      high = middle;
  }
  return low < size && entry_is(rows, first + low, j, s) ? first + low : NO_ENTRY;
}

static inline real largest_of_row(uint first, uint size, __global const stored_real* wall) {
  real largest = 0;
  for (uint k = first; k < first + size; ++k) largest = fmax(largest, wall[k]);
  return largest;
}

/* Work-item t makes the row of rank t: the walls of its pieces, sorted by the neighbours' place in the input
   and the number of the image, those with the same neighbour summed in the order of the pieces. Neighbours
   from rank `count` on are images: of rank image_seed[], with number image_shift[]. Behind them follow
   facet_size[i] facets of the domain, likewise; `facet` has a kind and an index for each of the facets of
   regions. The row of one piece stays where the walls are; that of several takes new room in the store, and
   where there is none its first piece counts as one that does not fit. Where walls are of `faces`, clears
   what match_rows adds to: the caller's `count` + 1 offsets and the lists of extra walls. */
__kernel void gather_rows(const uint count, const uint faces, __global const uint* order,
                          __global const ulong* pair_offset, const ulong pair_capacity,
                          __global const uint* pair_region, __global const uint* facet_offset,
                          __global const uint* facet, __global uint* pair_status,
                          __global const uint* piece_first, __global const uint* piece_size,
                          const uint capacity, volatile __global uint* used, __global uint* neighbor,
                          __global stored_real* wall, const int images, __global int* image,
                          __global const uint* image_seed, __global const int* image_shift,
                          __global uint* row_first, __global uint* row_size, __global uint* facet_size,
                          __global uint* last_extra, __global uint* offset) {
  const uint t = (uint)get_global_id(0);
  const bool walls = (faces & FACES_WALLS) != 0;
  if (t == count && walls) offset[count] = 0;
  if (t >= count) return;
  const uint i = order[t];
  row_first[i] = row_size[i] = facet_size[i] = 0;
  if (walls) offset[i] = last_extra[i] = 0;
  const ulong begin = pair_offset[t], end = pair_offset[t + 1];
  if (end > pair_capacity) return;
  uint pieces = 0, entries = 0, first = 0;
  for (ulong pair = begin; pair < end; ++pair) {
    if (piece_size[pair] == 0) continue;
    first = piece_first[pair];
    entries += piece_size[pair];
    ++pieces;
  }
  if (pieces == 0) return;
  if (pieces > 1) {
    first = *used <= capacity ? atomic_add(used, entries) : capacity;
    if (entries > capacity || first > capacity - entries) {
      pair_status[begin] = PIECE_FULL;
      return;
    }
  }
  const row_t row = {neighbor + first, wall + first, image + (images ? first : 0), images};
  uint size = 0;
  for (ulong pair = begin; pair < end; ++pair)
    for (uint k = piece_first[pair]; k < piece_first[pair] + piece_size[pair]; ++k) {
      const int border = (int)neighbor[k];
      if (border < 0) {
        const size_t slot = facet_offset[pair_region[pair]] + (uint)~border;
        size = add_to_row(row, size, ENTRY_FACET | facet[2 * slot + 1], 0, wall[k]);
        continue;
      }
      const uint rank = (uint)border;
      const bool moved = images && rank >= count;
      const uint seed = moved ? image_seed[rank - count] : rank;
      size = add_to_row(row, size, order[seed], moved ? image_shift[rank - count] : 0, wall[k]);
    }
  row_first[i] = first;
  while (size > 0 && row.neighbor[size - 1] >= ENTRY_FACET) {
    --size;
    ++facet_size[i];
  }
  row_size[i] = size;
}

/* Work-item i finds the final measure of each of its walls: the mean of both sides, of which the other one
   has the opposite image. A wall that only one cell has is rounding if it is small beside the largest of both
   cells, else the other cell has it too: its list of such walls, last_extra[j] and next[...], gets the entry,
   counted from 1. Adds what the rows will have to offset[]. */
__kernel void match_rows(const uint count, __global const uint* status, __global const uint* row_first,
                         __global const uint* row_size, __global uint* neighbor, __global stored_real* wall,
                         const int images, __global int* image, __global stored_real* matched,
                         __global uint* from, __global uint* next, volatile __global uint* last_extra,
                         volatile __global uint* offset) {
  const uint i = (uint)get_global_id(0);
  if (i >= count || status[i] != SEED_OK) return;
  const row_t rows = {neighbor, wall, image, images};
  const uint first = row_first[i], size = row_size[i];
  uint kept = 0;
  for (uint k = first; k < first + size; ++k) {
    const uint j = neighbor[k];
    const real here = wall[k];
    real measure = 0;
    if (status[j] == SEED_OK) {
      const uint back = find_in_row(rows, row_first[j], row_size[j], i, images ? -image[k] : 0);
      if (back != NO_ENTRY) {
        measure = (here + wall[back]) / 2;
      } else {
        const real largest =
            fmax(largest_of_row(first, size, wall), largest_of_row(row_first[j], row_size[j], wall));
        if (here > NEGLIGIBLE_WALL * largest) {
          measure = here;
          from[k] = i;
          next[k] = atomic_xchg(last_extra + j, k + 1);
          atomic_inc(offset + j);
        }
      }
    }
    matched[k] = measure;
    kept += measure > 0 ? 1u : 0u;
  }
  atomic_add(offset + i, kept);
}

/* Replaces the numbers of the images of a row, at the front of its memory, by their shifts from seed i as
   given, 3 each. `given` has the shift of each number, `wrapped` that from the wrapped to the given seed. */
static inline void write_shifts(row_t row, uint size, uint i, __global const int* given,
                                __global const int* wrapped) {
  for (uint k = size; k > 0; --k) {
    const size_t number = (size_t)(row.image[k - 1] + SHIFT_COUNT / 2), j = row.neighbor[k - 1];
    for (size_t m = 0; m < 3; ++m)
      row.image[3 * (size_t)(k - 1) + m] =
          given[3 * number + m] + (wrapped[3 * (size_t)i + m] - wrapped[3 * j + m]);
  }
}

/* Work-item i writes its row from offset[i] on, unless it ends beyond the caller's memory. */
__kernel void write_rows(const uint count, __global const uint* status, __global const uint* row_first,
                         __global const uint* row_size, __global const uint* neighbor, const int images,
                         __global const int* image, __global const int* given, __global const int* wrapped,
                         __global const stored_real* matched, __global const uint* from,
                         __global const uint* next, __global const uint* last_extra,
                         __global const stored_real* frame, __global const uint* offset, const uint capacity,
                         __global uint* row_neighbor, __global stored_real* row_wall,
                         __global int* row_shift) {
  const uint i = (uint)get_global_id(0);
  if (i >= count || status[i] != SEED_OK || offset[i + 1] > capacity) return;
  const row_t row = {row_neighbor + offset[i], row_wall + offset[i],
                     row_shift + (images ? 3 * (size_t)offset[i] : 0), images};
  real unit = 1;
  for (int k = 1; k < CELL_DIMENSION; ++k) unit *= frame[FRAME_UNIT];
  uint size = 0;
  for (uint k = row_first[i]; k < row_first[i] + row_size[i]; ++k)
    if (matched[k] > 0) set_entry(row, size++, neighbor[k], images ? image[k] : 0, matched[k] * unit);
  for (uint extra = last_extra[i]; extra != 0; extra = next[extra - 1])
    size = add_to_row(row, size, from[extra - 1], images ? -image[extra - 1] : 0, matched[extra - 1] * unit);
  if (images) write_shifts(row, size, i, given, wrapped);
}

/* Work-item i counts the facets of its cell that have a measure; the 0 at the end becomes the sum of all. */
__kernel void size_facets(const uint count, __global const uint* status, __global const uint* row_first,
                          __global const uint* row_size, __global const uint* facet_size,
                          __global const stored_real* wall, __global uint* offset) {
  const uint i = (uint)get_global_id(0);
  if (i > count) return;
  uint size = 0;
  if (i < count && status[i] == SEED_OK) {
    const uint first = row_first[i] + row_size[i];
    for (uint k = first; k < first + facet_size[i]; ++k) size += wall[k] > 0 ? 1u : 0u;
  }
  offset[i] = size;
}

/* Work-item i writes these from offset[i] on, unless they end beyond the caller's memory. */
__kernel void write_facets(const uint count, __global const uint* status, __global const uint* row_first,
                           __global const uint* row_size, __global const uint* facet_size,
                           __global const uint* neighbor, __global const stored_real* wall,
                           __global const stored_real* frame, __global const uint* offset,
                           const uint capacity, __global uint* facet, __global stored_real* measure) {
  const uint i = (uint)get_global_id(0);
  if (i >= count || status[i] != SEED_OK || offset[i + 1] > capacity) return;
  real unit = 1;
  for (int k = 1; k < CELL_DIMENSION; ++k) unit *= frame[FRAME_UNIT];
  const uint first = row_first[i] + row_size[i];
  uint at = offset[i];
  for (uint k = first; k < first + facet_size[i]; ++k) {
    if (!(wall[k] > 0)) continue;
    facet[at] = neighbor[k] & ~ENTRY_FACET;
    measure[at++] = wall[k] * unit;
  }
}
