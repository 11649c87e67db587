// The kernels' source compiled as C++ for one kind of cell: the including file defines DIMENSION,
// CELL_DIMENSION and the name of the namespace HOST_CLIP_SPACE.
#include <algorithm>
#include <bit>
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
#define LANES 8
#include "kernels/base/real.cl"
// needs real.cl
#include "lib/clip/host_lanes.hpp"
// needs the lanes
#include "kernels/neighbors/search.cl"
// after search.cl, which it shares includes with
#include "kernels/clip/write.cl"

/// A cell with room for `vertices` vertices, a multiple of 64.
class GrowingCell {
 public:
  explicit GrowingCell(std::size_t vertices)
      : real_(vertices * (DIMENSION + 1)), index_(vertices * 7), border_(vertices), word_(vertices / 32) {
    auto* real_at = real_.data();
    for (auto& row : cell.at.x) row = take(real_at, vertices);
    cell.at.side = take(real_at, vertices);
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
    } else {
      for (auto& row : c.next) row = take(at, vertices);
      for (auto& row : c.face) row = take(at, vertices);
      c.mark = take(at, vertices);
      points_.resize(2 * vertices);
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
  return {as_seeds(scene.points),    as_seeds(scene.node_low),
          as_seeds(scene.node_high), scene.tree->level_offset.data(),
          static_cast<int>(scene.tree->levels()), static_cast<uint>(scene.tree->seeds)};
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
    for (std::uint32_t node = 0; node < offset[static_cast<std::size_t>(level) + 1] - offset[static_cast<std::size_t>(level)]; ++node)
      pack_node_block(tree, node, level, scene.node_block.data());
}

/// One try with a capacity and a tolerance; the status may be PIECE_FULL or PIECE_TANGLED.
HostPiece clip(const HostScene& scene, std::uint32_t rank, std::uint32_t region, std::size_t vertices,
               double tolerance_factor) {
  HostPiece piece;
  GrowingCell room(vertices);
  cell_t& cell = room.cell;
  cell.tolerance_factor = static_cast<real>(tolerance_factor);
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
  if (status == PIECE_WHOLE) status = clip_by_tree(&cell, tree, blocks, rank);
  piece.status = write_piece(&cell, out, status, 0, 0);
  batch.border.resize(batch.faces(0));
  batch.wall.resize(batch.faces(0));
  batch.vertex.resize(batch.vertices(0) * DIMENSION);
  batch.link.resize(batch.vertices(0) * 6);
  return piece;
}

}  // namespace powercell::HOST_CLIP_SPACE
