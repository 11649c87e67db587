// The kernels' source compiled as C++ for one kind of cell: the including file defines DIMENSION,
// CELL_DIMENSION and the name of the namespace HOST_CLIP_SPACE.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kernels/layout.h"
#include "lib/clip/host_clip.hpp"

namespace powercell::HOST_CLIP_SPACE {
namespace {

using std::fabs, std::fmax, std::fmin, std::min, std::sqrt, std::size_t;
using uint = unsigned int;
using uchar = unsigned char;

#define REAL_BITS 80
#define OUTPUTS 7
#include "kernels/neighbors/tree.cl"
// after tree.cl, which it shares includes with
#include "kernels/clip/write.cl"

/// A cell with room for `vertices` vertices.
class GrowingCell {
 public:
  explicit GrowingCell(std::size_t vertices)
      : real_(vertices * (DIMENSION + 1)), index_(vertices * 8), border_(vertices) {
    auto* real_at = real_.data();
    for (auto& row : cell.x) row = take(real_at, vertices);
    cell.side = take(real_at, vertices);
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
    if constexpr (requires { c.mark; }) {
      auto* at = index_.data();
      for (auto& row : c.next) row = take(at, vertices);
      for (auto& row : c.face) row = take(at, vertices);
      c.mark = take(at, vertices);
    }
  }
  std::vector<real> real_;
  std::vector<index_t> index_;
  std::vector<int> border_;
};

const seed_t* as_seeds(const std::vector<std::byte>& bytes) {
  return reinterpret_cast<const seed_t*>(bytes.data());
}

}  // namespace

/// One try with a capacity and a tolerance; the status may be PIECE_FULL or PIECE_TANGLED.
HostPiece clip(const HostScene& scene, std::uint32_t rank, std::uint32_t region, std::size_t vertices,
               double tolerance_factor) {
  HostPiece piece;
  GrowingCell room(vertices);
  cell_t& cell = room.cell;
  cell.tolerance_factor = static_cast<real>(tolerance_factor);
  const tree_t tree = {as_seeds(scene.points),
                       as_seeds(scene.node_low),
                       as_seeds(scene.node_high),
                       scene.tree->level_offset.data(),
                       static_cast<int>(scene.tree->levels()),
                       static_cast<uint>(scene.tree->seeds)};
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
  if (status == PIECE_WHOLE) status = clip_by_tree(&cell, tree, rank);
  piece.status = write_piece(&cell, out, status, 0, 0);
  batch.border.resize(batch.faces(0));
  batch.wall.resize(batch.faces(0));
  batch.vertex.resize(batch.vertices(0) * DIMENSION);
  batch.link.resize(batch.vertices(0) * 6);
  return piece;
}

}  // namespace powercell::HOST_CLIP_SPACE
