/* The geometry of all cells as compressed sparse rows. clip/by_tree.cl clips some pairs at a time into rows
   of a fixed room each; of these, the kernels here count what there is, and after a second time of clipping
   copy it to where it belongs in the caller's memory. */
#include "base/real.cl"

/* In place of where a piece begins: it is not written. */
#define NO_PLACE 0xffffffffffffffffUL
/* In place of the number of faces: the piece did not fit, and is clipped with another program. */
#define NOT_COUNTED 0xffffffffu

static inline bool has_piece(uint status) {
  const uint piece = status & ~(uint)PIECE_UNCERTAIN;
  return piece == PIECE_DONE || piece == PIECE_FLAT;
}

/* Row t of the next launch is of entry first + t of the pairs, of which those of the first `count` seeds are
   used, or where `listed` of `list`, which has found[0] entries: active[t] is the pair, or NO_PAIR where
   there is none, it has no piece, or, where pieces are written (`placed`), not this one. */
__kernel void choose_rows(const uint rows, const uint first, const uint capacity, const uint count,
                          __global const ulong* offset, const int listed, __global const uint* list,
                          __global const uint* found, __global const uint* pair_status, const int placed,
                          __global const ulong* place, __global uint* active) {
  const uint t = (uint)get_global_id(0);
  if (t >= rows) return;
  const ulong entry = (ulong)first + t, end = min(offset[count], (ulong)capacity);
  uint pair = NO_PAIR;
  if (entry < (listed ? (ulong)found[0] : end)) {
    pair = listed ? list[entry] : (uint)entry;
    if (!has_piece(pair_status[pair]) || (placed && place[pair] == NO_PLACE)) pair = NO_PAIR;
  }
  active[t] = pair;
}

/* Row t: keeps by pair how many faces and vertices its piece has. A piece that did not fit is left for the
   next program, unless this is the last one. What is not clipped as it was before becomes unfinished. */
__kernel void count_rows(const uint rows, const int last, __global const uint* active,
                         __global const uint* row_status, __global const uint* row_faces,
                         __global const uint* row_vertices, __global uint* pair_status,
                         __global uint* piece_faces, __global uint* piece_vertices) {
  const uint t = (uint)get_global_id(0);
  if (t >= rows || active[t] == NO_PAIR) return;
  const uint pair = active[t], piece = row_status[t] & ~(uint)PIECE_UNCERTAIN;
  if (has_piece(piece)) {
    piece_faces[pair] = row_faces[t];
    piece_vertices[pair] = row_vertices[t];
  } else if (piece == PIECE_FULL && !last) {
    piece_faces[pair] = NOT_COUNTED;
  } else {
    pair_status[pair] = PIECE_TANGLED;
  }
}

/* Work-item t sums over the pairs of rank t; the seed is ok, so that all of them are finished. Work-item
   `count` writes the 0 at the end, which becomes the sum of all. */
__kernel void size_cells(const uint count, __global const uint* order, __global const uint* status,
                         __global const ulong* offset, __global const uint* pair_status,
                         __global const uint* piece_faces, __global const uint* piece_vertices,
                         __global ulong* cell_pieces, __global ulong* cell_vertices,
                         __global ulong* cell_faces) {
  const uint t = (uint)get_global_id(0);
  if (t > count) return;
  const size_t i = t < count ? order[t] : count;
  ulong pieces = 0, vertices = 0, faces = 0;
  if (t < count && status[i] == SEED_OK)
    for (ulong pair = offset[t]; pair < offset[t + 1]; ++pair)
      if (has_piece(pair_status[pair])) {
        ++pieces;
        vertices += piece_vertices[pair];
        faces += piece_faces[pair];
      }
  cell_pieces[i] = pieces;
  cell_vertices[i] = vertices;
  cell_faces[i] = faces;
}

/* A vertex of a polyhedron is in three loops. */
#define LOOPS_OF_VERTEX (CELL_DIMENSION == 3 ? 3 : 0)

/* Work-item t says where each piece of rank t begins, by the prefix sums of what size_cells has written: the
   number of the piece, and those of its first vertex and face. Work-item `count` writes how many of each
   there are, and the beginnings of the caller's offsets. */
__kernel void place_pieces(const uint count, const uint capacity, __global const uint* order,
                           __global const uint* status, __global const ulong* offset,
                           __global const uint* pair_status, __global const uint* piece_faces,
                           __global const uint* piece_vertices, __global const ulong* cell_pieces,
                           __global const ulong* cell_vertices, __global const ulong* cell_faces,
                           const ulong room_pieces, const ulong room_vertices, const ulong room_faces,
                           const ulong room_loop, __global ulong* place, __global ulong* place_vertices,
                           __global ulong* place_faces, __global ulong* counts, __global ulong* vertex_offset,
                           __global ulong* face_offset, __global ulong* loop_offset) {
  const uint t = (uint)get_global_id(0);
  if (t > count) return;
  if (t == count) {
    counts[0] = cell_pieces[count];
    counts[1] = cell_vertices[count];
    counts[2] = cell_faces[count];
    counts[3] = LOOPS_OF_VERTEX * cell_vertices[count];
    vertex_offset[0] = face_offset[0] = 0;
    if (CELL_DIMENSION == 3) loop_offset[0] = 0;
    return;
  }
  const size_t i = order[t];
  const bool written = status[i] == SEED_OK && cell_pieces[i + 1] <= room_pieces &&
                       cell_vertices[i + 1] <= room_vertices && cell_faces[i + 1] <= room_faces &&
                       LOOPS_OF_VERTEX * cell_vertices[i + 1] <= room_loop;
  ulong piece = cell_pieces[i], vertex = cell_vertices[i], face = cell_faces[i];
  for (ulong pair = offset[t]; pair < min(offset[t + 1], (ulong)capacity); ++pair) {
    place[pair] = NO_PLACE;
    if (!written || !has_piece(pair_status[pair])) continue;
    place[pair] = piece++;
    place_vertices[pair] = vertex;
    place_faces[pair] = face;
    vertex += piece_vertices[pair];
    face += piece_faces[pair];
  }
}

/* A piece in a row: its graph, link[6 v ..], as cell_write_vertices writes it (cell/polyhedron.cl). */
typedef struct {
  uint vertices, faces;
  __global const uint* link;
} graph_t;

/* Writes the loop of each face behind each other from entry `begin` of `loop` on, each from the least of its
   vertices, and to end[f] where that of face f ends. */
static inline void write_loops(graph_t graph, ulong begin, __global ulong* end, __global uint* loop) {
  for (uint f = 0; f < graph.faces; ++f) end[f] = 0;
  for (uint v = 0; v < graph.vertices; ++v)
    for (uint k = 3; k < 6; ++k) ++end[graph.link[6 * v + k]];
  ulong sum = begin;
  for (uint f = 0; f < graph.faces; ++f) end[f] = sum += end[f];
  for (uint v = graph.vertices; v > 0; --v)
    for (uint k = 3; k < 6; ++k) {
      const uint f = graph.link[6 * (v - 1) + k];
      loop[f == 0 ? begin : end[f - 1]] = v - 1;
    }
  for (uint f = 0; f < graph.faces; ++f)
    for (ulong at = f == 0 ? begin : end[f - 1]; at + 1 < end[f]; ++at) {
      const uint v = loop[at];
      uint k = 0;
      while (k < 2 && graph.link[6 * v + 3 + k] != f) ++k;
      loop[at + 1] = graph.link[6 * v + k];
    }
}

/* What is behind faces. */
typedef struct {
  uint count; /* of seeds: ranks from there on are images */
  __global const uint *order, *image_seed;
  __global const int *image_shift, *given, *wrapped; /* as in diagram/walls.cl */
  __global const uint *facet_offset, *facet;         /* facets of the domain: kind and index each */
} behind_t;

/* The kind and index of the border with code `border` of a piece in `region`. */
static inline void write_border(behind_t b, int border, uint region, __global uint* to) {
  if (border < 0) {
    const size_t facet = 2 * (size_t)(b.facet_offset[region] + (uint)~border);
    to[0] = b.facet[facet];
    to[1] = b.facet[facet + 1];
    return;
  }
  const uint rank = (uint)border;
  to[0] = BORDER_WALL;
  to[1] = b.order[rank < b.count ? rank : b.image_seed[rank - b.count]];
}

/* The shift of the neighbour of seed i as given behind that border. */
static inline void write_shift(behind_t b, int border, size_t i, __global int* to) {
  for (size_t m = 0; m < 3; ++m) to[m] = 0;
  if (border < 0) return;
  const uint rank = (uint)border;
  const bool moved = rank >= b.count;
  const size_t j = b.order[moved ? b.image_seed[rank - b.count] : rank],
               number = (size_t)((moved ? b.image_shift[rank - b.count] : 0) + SHIFT_COUNT / 2);
  for (size_t m = 0; m < 3; ++m)
    to[m] = b.given[3 * number + m] + (b.wrapped[3 * i + m] - b.wrapped[3 * j + m]);
}

/* Row t: writes its piece to where place_pieces puts it. Rows have room for `vertex_stride` vertices and
   `face_stride` faces. */
__kernel void write_rows(
    const uint rows, const uint vertex_stride, const uint face_stride, __global const uint* active,
    __global const uint* row_status, __global const uint* row_faces, __global const int* row_border,
    __global const uint* row_vertices, __global const stored_real* row_vertex, __global const uint* row_link,
    __global const uint* pair_seed, __global const uint* pair_region, __global const stored_real* frame,
    __global const stored_real* positions, const uint count, __global const uint* order, const int images,
    __global const uint* image_seed, __global const int* image_shift, __global const int* given,
    __global const int* wrapped, __global const uint* facet_offset, __global const uint* facet,
    __global const ulong* place, __global const ulong* place_vertices, __global const ulong* place_faces,
    __global uint* region, __global ulong* vertex_offset, __global stored_real* vertices,
    __global ulong* face_offset, __global uint* border, __global int* shift, __global ulong* loop_offset,
    __global uint* loop) {
  const uint t = (uint)get_global_id(0);
  if (t >= rows || active[t] == NO_PAIR || !has_piece(row_status[t])) return;
  const uint pair = active[t];
  const ulong piece = place[pair], first = place_vertices[pair], first_face = place_faces[pair];
  if (piece == NO_PLACE) return;
  const size_t i = order[pair_seed[pair]];
  const behind_t behind = {count, order, image_seed, image_shift, given, wrapped, facet_offset, facet};
  region[piece] = pair_region[pair];
  vertex_offset[piece + 1] = first + row_vertices[t];
  face_offset[piece + 1] = first_face + row_faces[t];
  const real unit = frame[FRAME_UNIT];
  __global const stored_real* y = row_vertex + (size_t)t * vertex_stride * DIMENSION;
  for (size_t v = 0; v < row_vertices[t]; ++v)
    UNROLL for (size_t k = 0; k < DIMENSION; ++k) vertices[(first + v) * DIMENSION + k] =
        positions[i * DIMENSION + k] + y[v * DIMENSION + k] * unit;
  for (size_t f = 0; f < row_faces[t]; ++f) {
    const int code = row_border[(size_t)t * face_stride + f];
    write_border(behind, code, pair_region[pair], border + 2 * (first_face + f));
    if (images) write_shift(behind, code, i, shift + 3 * (first_face + f));
  }
  if (CELL_DIMENSION == 3) {
    const graph_t graph = {row_vertices[t], row_faces[t], row_link + (size_t)t * vertex_stride * 6};
    write_loops(graph, 3 * first, loop_offset + first_face + 1, loop);
  }
}
