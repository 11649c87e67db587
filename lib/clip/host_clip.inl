// The kernels' source compiled as C++ for one kind of cell: the including file defines DIMENSION,
// CELL_DIMENSION and the name of the namespace HOST_CLIP_SPACE.
#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>

#include "kernels/layout.h"
#include "lib/clip/exact_cell.hpp"
#include "lib/clip/host_clip.hpp"
#include "lib/clip/seed_marks.hpp"

namespace powercell::HOST_CLIP_SPACE {
namespace {

using std::fabs, std::min, std::sqrt, std::size_t;
/* Of numbers: the library's, which care for NaN, are calls. */
inline double fmax(double a, double b) {
  return a < b ? b : a;
}
inline double fmin(double a, double b) {
  return b < a ? b : a;
}
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
        unit_of_(vertices),
        unit_(vertices),
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
    cell.unit = unit_.data();
    cell.unit_of = unit_of_.data();
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
  std::vector<ulong> unit_of_;
  std::vector<certain_plane_t> unit_;
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

void list_near_leaf(HostScene& scene, std::uint32_t leaf) {
  const blocks_t blocks = {scene.seed_block.data(), scene.node_block.data(), nullptr, nullptr, nullptr};
  scene.near_count[leaf] = find_near(tree_of(scene), blocks, leaf, &scene.near[std::size_t{leaf} * NEAR_MOST],
                                     &scene.near_bound[leaf]);
}

namespace {

/// What a piece leaves, in arrays with room for more.
struct Row {
  std::vector<int> border;
  std::vector<real> wall, vertex;
  std::vector<uint> link;
  uint faces = 0, vertices = 0;

  explicit Row(std::size_t capacity)
      : border(capacity), wall(capacity), vertex(capacity * DIMENSION), link(capacity * 6) {}
  void append_to(PieceBatch& batch, bool geometry) const {
    const auto add = [](auto& to, const auto& from, std::size_t count) {
      to.insert(to.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count));
    };
    if (batch.face_offset.empty()) batch.face_offset = batch.vertex_offset = {0};
    batch.face_offset.push_back(batch.face_offset.back() + faces);
    add(batch.border, border, faces);
    add(batch.wall, wall, faces);
    if (!geometry) return;
    batch.vertex_offset.push_back(batch.vertex_offset.back() + vertices);
    add(batch.vertex, vertex, vertices * DIMENSION);
    add(batch.link, link, vertices * 6);
  }
};

#include "lib/clip/host_walls.hpp"

/// Cuts by the seeds of the nearest leaves, nearest bisector first, so that the search of the tree starts
/// with a small cell. Returns a CUT code.
int cut_by_nearest(cell_t* cell, tree_t tree, std::uint32_t rank) {
  stack_t stack;
  std::array<std::pair<real, uint>, NEAR_SEEDS> order;
  std::size_t count = 0;
  const nearest_t near = find_near_leaves(tree, tree.seeds[rank], &stack);
  for (int k = 0; k < near.count; ++k)
    for (uint j = near.leaf[k] * TREE_FAN; j < min((near.leaf[k] + 1) * TREE_FAN, tree.count); ++j)
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

bool has_wall(const Row& row) {
  for (std::size_t k = 0; k < row.faces; ++k)
    if (row.border[k] >= 0 && row.wall[k] > 0) return true;
  return false;
}

class Clipper final : public HostClipper {
 public:
  Clipper(const HostScene& scene, bool geometry)
      : scene_(scene),
        geometry_(geometry),
        tree_(tree_of(scene)),
        exact_(scene),
        room_(least_room),
        row_(least_room) {}

  int clip(std::uint32_t rank, std::uint32_t region, std::span<double> moments, PieceBatch& rows) override {
    int status = clip_within(room_, row_, rank, region, moments.data());
    if (status == PIECE_FULL) {  // room that few need, not kept: no cell depends on those before
      std::size_t vertices = least_room;
      while (status == PIECE_FULL) {
        vertices *= 4;
        GrowingCell room(vertices);
        Row row(vertices);
        status = clip_within(room, row, rank, region, moments.data());
        if (status != PIECE_FULL) row.append_to(rows, geometry_);
      }
    } else {
      row_.append_to(rows, geometry_);
    }
    if (status != PIECE_TANGLED) return status;
    throw Error(ErrorCode::internal, "the cell of the seed at position " + std::to_string(rank) +
                                         " of the Hilbert order could not be clipped without contradiction "
                                         "even on the host; please report the input");
  }

 private:
  static constexpr std::size_t least_room = 256;

  /// One try with a capacity; the status may be PIECE_FULL or PIECE_TANGLED.
  int clip_within(GrowingCell& room, Row& row, std::uint32_t rank, std::uint32_t region, real* moments) {
    cell_t& cell = room.cell;
    exact_.start(rank, region);
    tried_.clear();
    cell.exact = &exact_;
    cell.tried = &tried_;
    const blocks_t blocks = {scene_.seed_block.data(), scene_.node_block.data(), scene_.near.get(),
                             scene_.near_count.data(), scene_.near_bound.data()};
    row.faces = row.vertices = 0;
    const output_t out = {moments,       &row.faces,        row.border.data(), row.wall.data(),
                          &row.vertices, row.vertex.data(), row.link.data()};
    const regions_t regions = {as_seeds(scene_.corners), scene_.mesh->region_offset.data(),
                               scene_.mesh->region_vertex.data(), scene_.behind.data(), &scene_.shape};
    int status = cell_start(&cell, regions, tree_.seeds, rank, region);
    if (status == PIECE_WHOLE) {
      host_start(&cell);
      const bool listed = scene_.near_count[rank / TREE_FAN] > 0;
      const int cut = listed ? CUT_NONE : cut_by_nearest(&cell, tree_, rank);
      status = cut > CUT_SHRUNK ? piece_status(cut) : clip_by_tree(&cell, tree_, blocks, rank);
    }
    status = write_piece(&cell, out, status, 0, 0) & ~PIECE_UNCERTAIN;
    if (status != PIECE_WHOLE && status != PIECE_FLAT) return status;
    const int facets = CELL_DIMENSION == 3
                           ? scene_.shape.faces
                           : static_cast<int>(regions.offset[region + 1] - regions.offset[region]);
    settle_small_walls(cell, row);
    settle_walls_in_facets(cell, facets, status == PIECE_FLAT, row);
    if (status == PIECE_WHOLE || has_wall(row)) return status;
    row.faces = row.vertices = 0;
    return PIECE_EMPTY;
  }

  const HostScene& scene_;
  const bool geometry_;
  tree_t tree_;
  ExactCell exact_;
  SeedMarks tried_;
  GrowingCell room_;
  Row row_;
};

}  // namespace

std::unique_ptr<HostClipper> make_clipper(const HostScene& scene, bool geometry) {
  return std::make_unique<Clipper>(scene, geometry);
}

}  // namespace powercell::HOST_CLIP_SPACE
