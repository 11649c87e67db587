// The kernels' source compiled as C++ for one kind of cell: the including file defines DIMENSION,
// CELL_DIMENSION and the name of the namespace HOST_CLIP_SPACE.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "kernels/layout.h"
#include "lib/clip/exact_cell.hpp"
#include "lib/clip/host_clip.hpp"

namespace powercell::HOST_CLIP_SPACE {
namespace {

using std::fabs, std::fmax, std::fmin, std::min, std::sqrt, std::size_t;
using uint = unsigned int;
using uchar = unsigned char;

#define REAL_BITS 64
#define OUTPUTS 7
#define LANES 8
#include "kernels/base/real.cl"
// Defined after the cell.
template <class Cell>
void host_place(Cell* cell, int v);
template <class Cell>
real host_tolerance(const Cell* cell, real sum, real q2, real dw);
template <class Cell>
int host_sides(Cell* cell, int border, int* vertices, int* inside);
template <class Cell>
bool host_finish(Cell* cell);
template <class Cell>
bool host_is_flat(const Cell* cell, real* moments);
// needs real.cl
#include "lib/clip/host_lanes.hpp"
// needs the lanes
#include "kernels/neighbors/search.cl"
// after search.cl, which it shares includes with
#include "kernels/clip/write.cl"
// needs the cell
#include "lib/clip/host_decide.hpp"

/// A cell with room for `vertices` vertices, a multiple of 64.
class GrowingCell {
 public:
  explicit GrowingCell(std::size_t vertices)
      : real_(vertices * (DIMENSION + 3)),
        index_(vertices * 7),
        border_(vertices),
        word_(vertices / 32),
        points_(2 * vertices) {
    auto* real_at = real_.data();
    for (auto& row : cell.at.x) row = take(real_at, vertices);
    cell.at.side = take(real_at, vertices);
    cell.doubt = take(real_at, vertices);
    cell.error = take(real_at, vertices);
    cell.at.used = word_.data();
    cell.at.outside = word_.data() + vertices / 64;
    cell.border = border_.data();
    cell.vertex_capacity = cell.face_capacity = static_cast<int>(vertices);
    link_graph(cell, vertices);
  }
  cell_t cell{};

 private:
  template <class T>
  static T* take(T*& at, std::size_t count) {
    T* const here = at;
    at += count;
    return here;
  }
  template <class Cell>
  void link_graph(Cell& c, std::size_t vertices) {
    auto* at = index_.data();
    if constexpr (requires { c.previous; }) {
      c.next = take(at, vertices);
      c.previous = take(at, vertices);
      c.line = points_.data();
    } else {
      for (auto& row : c.next) row = take(at, vertices);
      for (auto& row : c.face) row = take(at, vertices);
      c.mark = take(at, vertices);
      c.point = points_.data();
      c.normal = points_.data() + vertices;
    }
  }
  std::vector<real> real_;
  std::vector<index_t> index_;
  std::vector<int> border_;
  std::vector<ulong> word_;
  std::vector<real4> points_;
};

const seed_t* as_seeds(const std::vector<std::byte>& bytes) {
  return reinterpret_cast<const seed_t*>(bytes.data());
}

}  // namespace

namespace {

tree_t tree_of(const HostScene& scene) {
  return {as_seeds(scene.points),
          as_seeds(scene.node_low),
          as_seeds(scene.node_high),
          scene.tree->level_offset.data(),
          static_cast<int>(scene.tree->levels()),
          static_cast<uint>(scene.tree->seeds)};
}

}  // namespace

/// As the kernels of kernels/neighbors/build_blocks.cl do.
void pack_blocks(HostScene& scene) {
  const tree_t tree = tree_of(scene);
  const std::vector<std::uint32_t>& offset = scene.tree->level_offset;
  const std::uint32_t leaves = offset[1];
  scene.seed_block.resize(std::size_t{leaves} * SEED_BLOCK);
  scene.node_block.resize(std::size_t{offset.back() - leaves} * NODE_BLOCK);
  scene.near_count.assign(leaves, 0);
  scene.near_bound.assign(leaves, -std::numeric_limits<double>::max());
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) pack_seed_block(tree, leaf, scene.seed_block.data());
  for (int level = 1; level < tree.levels; ++level)
    for (std::uint32_t node = 0;
         node < offset[static_cast<std::size_t>(level) + 1] - offset[static_cast<std::size_t>(level)]; ++node)
      pack_node_block(tree, node, level, scene.node_block.data());
}

/// Facet f of the region in whose plane face `face` lies, or -1.
int facet_of_face(const cell_t& cell, int face, int facets) {
  const std::vector<int> vertices = vertices_of_face(&cell, face);
  for (int f = 0; f < facets; ++f) {
    const certain_plane_t plane = facet_of_region(&cell, f);
    const auto lies_in = [&](int v) {
      real s = -plane.plane.w;
      const real n[3] = {plane.plane.x, plane.plane.y, plane.plane.z};
      for (int k = 0; k < DIMENSION; ++k) s += n[k] * cell.at.x[k][v];
      if (fabs(s) > final_error * cell.at.radius + cell.error[v] + plane.doubt) return false;
      return cell.exact->lies_in_facet(vertex_planes(&cell, v), f);
    };
    if (std::all_of(vertices.begin(), vertices.end(), lies_in)) return f;
  }
  return -1;
}

/// What lies behind a face with `border` in the plane of facet f, once ties have no thickness: the seed, if
/// it has the region behind the facet (or, for a flat piece, if the cell itself has it), else the facet
/// (docs/mathematics.md, "Walls in facets").
int border_in_facet(const cell_t& cell, int border, int f, bool flat) {
  const int behind = cell.at.behind[f];
  if (behind == BEHIND_NOTHING) return ~f;
  if (DIMENSION == CELL_DIMENSION) return border;
  return cell.exact->is_corner_outside(static_cast<uint>(behind), border) != flat ? border : ~f;
}

void settle_walls_in_facets(const cell_t& cell, int facets, bool flat, PieceBatch& batch) {
  int face = first_face(cell);
  for (std::size_t k = 0; k < batch.border.size(); ++k, face = after_face(cell, face)) {
    if (batch.border[k] < 0 || batch.wall[k] == 0) continue;
    const int f = facet_of_face(cell, face, facets);
    if (f >= 0) batch.border[k] = border_in_facet(cell, batch.border[k], f, flat);
  }
}

/// Walls whose measure is 0 without the infinitesimals of ties measure 0, to the bit.
void clear_degenerate_walls(const cell_t& cell, PieceBatch& batch) {
  const real plain = plainly_solid * (CELL_DIMENSION == 3 ? cell.at.radius * cell.at.radius : cell.at.radius);
  int face = first_face(cell);
  for (std::size_t k = 0; k < batch.wall.size(); ++k) {
    if (!(batch.wall[k] > plain) && is_degenerate(&cell, face, CELL_DIMENSION - 1)) batch.wall[k] = 0;
    face = after_face(cell, face);
  }
}

/// Cuts by the seeds of the nearest leaves, nearest bisector first, so that the search of the tree starts
/// with a small cell. Returns a CUT code.
int cut_by_nearest(cell_t* cell, tree_t tree, std::uint32_t rank) {
  stack_t stack;
  uint leaf[NEAR_LEAVES_MOST];
  std::array<std::pair<real, uint>, NEAR_SEEDS> order;
  std::size_t count = 0;
  const int leaves = find_near_leaves(tree, tree.seeds[rank], &stack, leaf);
  for (int k = 0; k < leaves; ++k)
    for (uint j = leaf[k] * TREE_FAN; j < min(leaf[k] * TREE_FAN + TREE_FAN, tree.count); ++j)
      if (j != rank) order[count++] = {bisector_distance(tree.seeds[rank], tree.seeds[j]), j};
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t k = 0; k < count && order[k].first <= 2 * cell->at.radius; ++k) {
    const uint j = order[k].second;
    const int cut = cut_by_seed(cell, tree.seeds[rank], tree.seeds[j], static_cast<int>(j));
    if (cut > CUT_SHRUNK) return cut;
    if (cut == CUT_SHRUNK) find_radius2(&cell->at);
  }
  return CUT_NONE;
}

/// The first `count` values alone, in memory for no more: a chunk may hold very many such rows.
template <class T>
void keep(std::vector<T>& values, std::size_t count) {
  values = std::vector<T>(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

bool has_wall(const PieceBatch& batch) {
  for (std::size_t k = 0; k < batch.border.size(); ++k)
    if (batch.border[k] >= 0 && batch.wall[k] > 0) return true;
  return false;
}

/// One try with a capacity; the status may be PIECE_FULL.
HostPiece clip(const HostScene& scene, std::uint32_t rank, std::uint32_t region, std::size_t vertices) {
  HostPiece piece;
  GrowingCell room(vertices);
  cell_t& cell = room.cell;
  const std::unique_ptr<ExactCell> exact = ExactCell::make(scene, rank, region);
  cell.exact = exact.get();
  const tree_t tree = tree_of(scene);
  const blocks_t blocks = {scene.seed_block.data(), scene.node_block.data(), nullptr, scene.near_count.data(),
                           scene.near_bound.data()};
  PieceBatch& batch = piece.batch;
  batch.face_offset = batch.vertex_offset = {0, 0};
  batch.border.resize(vertices);
  batch.wall.resize(vertices);
  batch.vertex.resize(vertices * DIMENSION);
  batch.link.resize(vertices * 6);
  piece.moments.resize(2 + DIMENSION);
  const output_t out = {piece.moments.data(), &batch.face_offset[1],   batch.border.data(),
                        batch.wall.data(),    &batch.vertex_offset[1], batch.vertex.data(),
                        batch.link.data()};
  const regions_t regions = {as_seeds(scene.corners), scene.mesh->region_offset.data(),
                             scene.mesh->region_vertex.data(), scene.behind.data(), &scene.shape};
  int status = cell_start(&cell, regions, tree.seeds, rank, region);
  host_start(&cell);
  if (status == PIECE_WHOLE) {
    const int cut = cut_by_nearest(&cell, tree, rank);
    status = cut > CUT_SHRUNK ? piece_status(cut) : clip_by_tree(&cell, tree, blocks, rank);
  }
  piece.status = write_piece(&cell, out, status, 0, 0) & ~PIECE_UNCERTAIN;
  keep(batch.border, batch.faces(0));
  keep(batch.wall, batch.faces(0));
  keep(batch.vertex, batch.vertices(0) * DIMENSION);
  keep(batch.link, batch.vertices(0) * 6);
  if (piece.status == PIECE_WHOLE || piece.status == PIECE_FLAT) {
    const int facets = CELL_DIMENSION == 3
                           ? scene.shape.faces
                           : static_cast<int>(regions.offset[region + 1] - regions.offset[region]);
    clear_degenerate_walls(cell, batch);
    settle_walls_in_facets(cell, facets, piece.status == PIECE_FLAT, batch);
    if (piece.status == PIECE_FLAT && !has_wall(batch)) {
      piece.status = PIECE_EMPTY;
      batch = PieceBatch{{0, 0}, {}, {}, {0, 0}, {}, {}};
    }
  }
  return piece;
}

}  // namespace powercell::HOST_CLIP_SPACE
