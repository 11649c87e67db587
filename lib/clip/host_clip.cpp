#include "lib/clip/host_clip.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "lib/clip/host_polygon.hpp"
#include "lib/clip/host_polyhedron.hpp"
#include "lib/clip/host_search.hpp"
#include "lib/clip/host_walls.hpp"

namespace powercell {
namespace {

/// \tparam Cell  HostPolygon or HostPolyhedron
template <class Cell>
class PieceClipper final : public HostClipper {
 public:
  PieceClipper(const HostScene& scene, bool geometry, bool perturbed)
      : scene_(scene), geometry_(geometry), perturbed_(perturbed), exact_(scene), search_(scene) {}

  bool met_tie() const override { return exact_.met_tie(); }

  int clip(std::uint32_t rank, std::uint32_t region, std::span<double> moments, PieceBatch& rows) override {
    start(rank, region);
    search_.start(rank);
    return finish(cut_by_all(), moments, rows);
  }

  int clip_by(std::uint32_t rank, std::uint32_t region, std::span<const std::uint32_t> others,
              std::span<double> moments, PieceBatch& rows) override {
    start(rank, region);
    const bool is_left =
        std::all_of(others.begin(), others.end(), [this](std::uint32_t other) { return cut_by(other); });
    return finish(is_left, moments, rows);
  }

  double radius() const override { return radius_; }

 private:
  using Wall = typename HostWalls<Cell>::Wall;

  /// \param is_left  whether the cell has points
  int finish(bool is_left, std::span<double> moments, PieceBatch& rows) {
    std::array<double, 5> sums{};
    std::vector<Wall> walls;
    int status = is_left ? PIECE_DONE : PIECE_EMPTY;
    if (status == PIECE_DONE) {
      cell_.finish({exact_, radius_, true});
      sums = cell_.moments();
      HostWalls<Cell> finished(cell_, exact_, radius_);
      if (perturbed_)
        walls = finished.perturbed();
      else
        status = drop_infinitesimals(region_number_, finished, sums, walls);
    }
    std::copy_n(sums.begin(), moments.size() - 1, moments.begin());
    moments.back() = sums.back();
    append_row(status, walls, rows);
    return status;
  }

  /// \return the status of the piece, which is not empty with the infinitesimals
  int drop_infinitesimals(std::uint32_t region, HostWalls<Cell>& finished, std::array<double, 5>& sums,
                          std::vector<Wall>& walls) {
    const bool flat = finished.is_flat(sums);
    if (flat) sums = {};
    walls = finished.settle(region_, &scene_.behind[scene_.mesh->facet_offset[region]], flat);
    const auto is_wall = [](const Wall& wall) { return wall.border >= 0 && wall.measure > 0; };
    if (!flat) return PIECE_DONE;
    return std::any_of(walls.begin(), walls.end(), is_wall) ? PIECE_FLAT : PIECE_EMPTY;
  }

  void start(std::uint32_t rank, std::uint32_t region) {
    const RegionMesh& mesh = *scene_.mesh;
    rank_ = rank;
    region_number_ = region;
    exact_.start(rank, region);
    region_ = {{}, 0, mesh.dimension != mesh.cell_dimension, &scene_.shape};
    double reach = 0;
    for (std::uint32_t k = mesh.region_offset[region]; k < mesh.region_offset[region + 1]; ++k) {
      region_.corner.push_back(position(scene_.corners[mesh.region_vertex[k]]) -
                               position(scene_.points[rank]));
      reach = std::max(reach, sum_of_sizes(region_.corner.back()));
    }
    region_.corner_error = 2 * rounding_unit * reach;
    cell_.start(region_);
    find_radius();
  }

  /// False if nothing is left.
  bool cut_by_all() {
    const auto vertices = [&] {
      std::vector<Point> points(cell_.size());
      for (std::size_t v = 0; v < points.size(); ++v) points[v] = cell_.vertex(v).at;
      return points;
    };
    while (const auto other = search_.next(radius_, vertices))
      if (!cut_by(*other)) return false;
    return true;
  }

  /// Cuts the cell by the bisector with a seed. No vertex is on it: where the errors leave a side open, it is
  /// decided exactly. False if nothing is left.
  bool cut_by(std::uint32_t other) {
    const std::array<double, 4>&here = scene_.points[rank_], &there = scene_.points[other];
    const Point q = position(there) - position(here);
    const Bisector bisector{q, dot(q, q), here[3] - there[3]};
    const double rounding = bisector.rounding(radius_), size = 2 * sum_of_sizes(q),
                 offset = bisector.offset();
    const std::size_t count = cell_.size();
    std::size_t inside = 0, outside = 0;
    side_.resize(count);
    for (std::size_t v = 0; v < count; ++v) {
      const HostPoint& p = cell_.vertex(v);
      const double side = 2 * dot(q, p.at) - offset, error = rounding + size * p.error;
      const int is_outside = side > error, is_inside = side < -error;
      side_[v] = is_outside - is_inside;
      inside += is_inside;
    }
    if (inside == count) return true;
    const auto border = static_cast<std::int32_t>(other);
    for (std::size_t v = 0; v < count; ++v) {
      if (side_[v] == 0) side_[v] = exact_.is_outside(cell_.borders(v), border) ? 1 : -1;
      outside += side_[v] > 0;
    }
    if (outside == 0) return true;
    if (outside == count) return false;
    if (!cell_.cut(side_, {border, plane_of(bisector)}, {exact_, radius_, false}))
      throw Error(ErrorCode::internal, "the cell of the seed at position " + std::to_string(rank_) +
                                           " of the Hilbert order could not be clipped without contradiction "
                                           "even on the host; please report the input");
    find_radius();
    return true;
  }

  void find_radius() {
    double square = 0;
    for (std::size_t v = 0; v < cell_.size(); ++v)
      square = std::max(square, dot(cell_.vertex(v).at, cell_.vertex(v).at));
    radius_ = std::sqrt(square) * (1 + 8 * rounding_unit);
  }

  void append_row(int status, const std::vector<Wall>& walls, PieceBatch& rows) const {
    if (rows.face_offset.empty()) rows.face_offset = rows.vertex_offset = {0};
    if (status != PIECE_EMPTY) {
      for (const auto& [border, measure] : walls) {
        rows.border.push_back(border);
        rows.wall.push_back(measure);
      }
      if (geometry_) cell_.write_vertices(rows, coordinates());
    }
    rows.face_offset.push_back(static_cast<std::uint32_t>(rows.border.size()));
    if (geometry_)
      rows.vertex_offset.push_back(static_cast<std::uint32_t>(rows.vertex.size() / coordinates()));
  }
  std::size_t coordinates() const { return static_cast<std::size_t>(scene_.mesh->dimension); }

  const HostScene& scene_;
  const bool geometry_, perturbed_;
  ExactCell exact_;
  HostSearch search_;
  Cell cell_;
  HostRegion region_;
  std::uint32_t rank_ = 0, region_number_ = 0;
  double radius_ = 0;  ///< no vertex is farther from the seed
  std::vector<double> side_;
};

std::vector<std::array<double, 4>> pack(const Frame& frame, int dimension, std::span<const double> positions,
                                        std::span<const double> weights) {
  std::vector<std::array<double, 4>> points(positions.size() / static_cast<std::size_t>(dimension));
  static_assert(sizeof points[0] == Frame::point_bytes);
  frame.pack_to(reinterpret_cast<std::byte*>(points.data()), dimension, positions, weights, 1);
  return points;
}

}  // namespace

HostScene make_host_scene(const RegionMesh& mesh, const Frame& frame,
                          std::vector<std::array<double, 4>> points) {
  return {&mesh,
          nullptr,
          pack(frame, mesh.dimension, mesh.vertices, {}),
          std::move(points),
          {},
          regions_behind(mesh),
          region_shape(mesh.shape)};
}

HostScene make_host_scene(const Scene& scene) {
  Frame frame = scene.frame();
  frame.split = false;  // differences of doubles need no shift, and scaling is exact
  frame.centre = {};
  const SeedSet& seeds = scene.seeds;
  const PackedTree& tree = scene.tree;
  HostScene host =
      make_host_scene(scene.mesh(), frame, pack(frame, seeds.dimension, seeds.positions, seeds.weights));
  host.tree = &tree;
  host.ties_by_position = scene.ties_by_position;
  const auto low = pack(frame, tree.dimension, tree.low, tree.weight);
  const auto high = pack(frame, tree.dimension, tree.high, {});
  for (std::size_t k = 0; k < low.size(); ++k)
    host.nodes.push_back({position(low[k]), position(high[k]), low[k][3]});
  return host;
}

std::unique_ptr<HostClipper> HostClipper::make(const HostScene& scene, bool geometry, bool perturbed) {
  if (scene.mesh->cell_dimension == 3)
    return std::make_unique<PieceClipper<HostPolyhedron>>(scene, geometry, perturbed);
  return std::make_unique<PieceClipper<HostPolygon>>(scene, geometry, perturbed);
}

}  // namespace powercell
