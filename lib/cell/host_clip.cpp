#include "lib/cell/host_clip.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "lib/base/vectors.hpp"
#include "lib/cell/host_polygon.hpp"
#include "lib/cell/host_polyhedron.hpp"
#include "lib/cell/host_search.hpp"
#include "lib/cell/host_walls.hpp"
#include "lib/cell/tie_sets.hpp"
#include "lib/cell/vertex_search.hpp"

namespace powercell {
namespace {

/// \tparam Cell  HostPolygon or HostPolyhedron
template <class Cell>
class PieceClipper final : public HostClipper {
 public:
  PieceClipper(const HostScene& scene, bool geometry, bool perturbed)
      : scene_(scene),
        geometry_(geometry),
        perturbed_(perturbed),
        exact_(scene),
        search_(scene),
        vertex_search_(scene),
        close_search_(scene),
        tie_sets_(scene) {}

  bool met_tie() const override { return exact_.met_tie(); }

  int clip(std::uint32_t rank, std::uint32_t region, std::span<double> moments, PieceBatch& rows) override {
    start(rank, region);
    search_.start(rank);
    return finish(cut_by_all(), moments, rows);
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
    exact_decisions_ = 0;
  }

  /// After so many exact decisions about a cell, vertices are placed exactly first: most decisions that
  /// follow need no other.
  static constexpr int exact_most = 160;
  static constexpr std::size_t doubtful_most = 12;

  /// False if nothing is left.
  bool cut_by_all() {
    const auto vertices = [&] {
      std::vector<Point> points(cell_.size());
      for (std::size_t v = 0; v < points.size(); ++v) points[v] = cell_.vertex(v).at;
      return points;
    };
    while (const auto other = search_.next(radius_, vertices))
      if (!cut_by(*other)) return false;
    return search_.gave_up() ? cut_by_vertices() : true;
  }

  /// The same by a search for each vertex, until no seed is nearer to any vertex than the cell's own. Which
  /// seeds cut on the way depends on the cells before. The result does not: faces and vertices are sorted.
  bool cut_by_vertices() {
    vertex_search_.start(rank_);
    open_.resize(cell_.size());
    std::iota(open_.begin(), open_.end(), 0U);
    side_.assign(cell_.size(), 0);
    bool tied = false, tied_on_the_way = exact_.met_tie();
    while (!open_.empty()) {
      const std::uint32_t v = open_.back();
      open_.pop_back();
      if (v >= cell_.size() || cell_.vertex(v).is_verified) continue;
      exact_.set_met_tie(false);
      const std::optional<std::uint32_t> other = find_cutter(v);
      if (!other) {
        cell_.set_verified(v);
        tied = tied || exact_.met_tie();
        continue;
      }
      const Cutter cutter = cutter_of(*other);
      find_outside_from(v, cutter);
      tied_on_the_way = tied_on_the_way || exact_.met_tie();
      if (outside_.size() == cell_.size()) {
        exact_.set_met_tie(tied_on_the_way);
        return false;
      }
      cut(cutter);
      open_.insert(open_.end(), cell_.changed().begin(), cell_.changed().end());
    }
    exact_.set_met_tie(tied);
    cell_.sort_faces([this](std::int32_t a, std::int32_t b) {
      return a < 0 || b < 0 ? a < b : place_in_order(a) < place_in_order(b);
    });
    find_radius();
    return true;
  }

  /// Sorts bisectors by the positions of their seeds alone: ranks differ between diagrams.
  std::array<double, 4> place_in_order(std::int32_t other) const {
    const Point q = position(scene_.points[static_cast<std::size_t>(other)]) - position(scene_.points[rank_]);
    return {dot(q, q), q[0], q[1], q[2]};
  }

  /// A seed that is nearer to the vertex than the cell's own. If doubles leave more than a few in doubt,
  /// pairs of doubles search again. Exact decisions settle the rest.
  std::optional<std::uint32_t> find_cutter(std::uint32_t v) {
    const ExactVertex borders = cell_.borders(v);
    const std::vector<std::uint32_t> corners = corners_of(borders);
    if (const auto* ties = corners.empty() ? nullptr : tie_sets_.find(corners)) {
      exact_.set_met_tie(true);
      return tie_sets_.taker(*ties, corners, borders, exact_);
    }
    sharpen(v);
    const HostPoint& vertex = cell_.vertex(v);
    const std::size_t most = is_on_bisector(borders) ? doubtful_most : scene_.points.size();
    if (const auto other = vertex_search_.find(vertex.at, vertex.error, most)) return other;
    if (vertex_search_.doubtful().size() <= most) return find_exactly(borders, vertex_search_.doubtful());
    close_search_.start(rank_);
    const ClosePoint place = exact_.place(borders);
    const double error = ExactCell::place_error * sum_of_sizes(vertex.at);
    if (const auto other = close_search_.find(place, error, scene_.points.size())) return other;
    return find_exactly(borders, close_search_.doubtful());
  }

  /// The seeds that are equally near to a vertex, that of the cell first; none if a facet of the region meets
  /// in it.
  std::vector<std::uint32_t> corners_of(const ExactVertex& borders) const {
    std::vector<std::uint32_t> corners{rank_};
    for (std::size_t k = 0; k < Cell::dimension; ++k) {
      if (borders[k] < 0) return {};
      corners.push_back(static_cast<std::uint32_t>(borders[k]));
    }
    if (scene_.mesh->dimension != scene_.mesh->cell_dimension) return {};
    return corners;
  }

  /// Decides about all of many seeds, to know next time which of them tie.
  /// \param ties  the corners of the vertex
  std::optional<std::uint32_t> find_and_learn(const ExactVertex& borders,
                                              const std::vector<std::uint32_t>& others,
                                              std::vector<std::uint32_t> ties) {
    const std::size_t corners = ties.size();
    std::optional<std::uint32_t> nearer, by_tie;
    const bool had_met = exact_.met_tie();
    for (const std::uint32_t other : others) {
      exact_.set_met_tie(false);
      const bool outside = exact_.is_outside(borders, static_cast<std::int32_t>(other));
      if (exact_.met_tie())
        ties.push_back(other);
      else if (outside)
        nearer = other;
      if (nearer) break;
      if (outside) by_tie = other;
    }
    exact_.set_met_tie(had_met || ties.size() > corners);
    if (nearer) return nearer;
    std::sort(ties.begin(), ties.end());
    ties.erase(std::unique(ties.begin(), ties.end()), ties.end());
    tie_sets_.learn(std::move(ties));
    return by_tie;
  }

  std::optional<std::uint32_t> find_exactly(const ExactVertex& borders,
                                            const std::vector<std::uint32_t>& others) {
    if (others.size() >= TieSets::least)
      if (std::vector<std::uint32_t> corners = corners_of(borders); !corners.empty())
        return find_and_learn(borders, others, std::move(corners));
    const auto found = std::find_if(others.begin(), others.end(), [&](std::uint32_t other) {
      return exact_.is_outside(borders, static_cast<std::int32_t>(other));
    });
    return found == others.end() ? std::nullopt : std::optional(*found);
  }

  static bool is_on_bisector(const ExactVertex& borders) {
    return std::any_of(borders.begin(), borders.begin() + Cell::dimension,
                       [](std::int32_t border) { return border >= 0; });
  }

  struct Cutter {
    std::int32_t border;
    Bisector bisector;
    double rounding, size, offset;
  };

  Cutter cutter_of(std::uint32_t other) const {
    const std::array<double, 4>&here = scene_.points[rank_], &there = scene_.points[other];
    const Point q = position(there) - position(here);
    const Bisector bisector{q, dot(q, q), here[3] - there[3]};
    return {static_cast<std::int32_t>(other), bisector, bisector.rounding(radius_), 2 * sum_of_sizes(q),
            bisector.offset()};
  }

  /// Above 0 if the vertex is outside, below 0 if inside, 0 if the errors leave that open.
  int side_by_numbers(std::size_t v, const Cutter& cutter) const {
    const HostPoint& p = cell_.vertex(v);
    const double side = 2 * dot(cutter.bisector.q, p.at) - cutter.offset,
                 error = cutter.rounding + cutter.size * p.error;
    const int is_outside = side > error, is_inside = side < -error;
    return is_outside - is_inside;
  }

  bool is_outside_exactly(std::size_t v, const Cutter& cutter) {
    if (++exact_decisions_ > exact_most) {
      sharpen(v);
      if (const int side = side_by_numbers(v, cutter)) return side > 0;
    }
    return exact_.is_outside(cell_.borders(v), cutter.border);
  }

  /// Corners of the region are sharp.
  void sharpen(std::size_t v) {
    const HostPoint& p = cell_.vertex(v);
    if (p.error <= 8 * rounding_unit * sum_of_sizes(p.at)) return;
    if (is_on_bisector(cell_.borders(v))) cell_.sharpen(v, {exact_, radius_, false});
  }

  /// Cuts the cell by the bisector with a seed. No vertex is on it: where the errors leave a side open, it is
  /// decided exactly. False if nothing is left.
  bool cut_by(std::uint32_t other) {
    const Cutter cutter = cutter_of(other);
    const std::size_t count = cell_.size();
    bool any = false;
    side_.resize(count);
    outside_.clear();
    for (std::size_t v = 0; v < count; ++v) {
      side_[v] = static_cast<std::int8_t>(side_by_numbers(v, cutter));
      any = any || side_[v] >= 0;
    }
    if (!any) return true;
    for (std::size_t v = 0; v < count; ++v)
      if (side_[v] > 0 || (side_[v] == 0 && is_outside_exactly(v, cutter)))
        outside_.push_back(static_cast<std::uint32_t>(v));
    if (outside_.empty()) return true;
    if (outside_.size() == count) return false;
    cut(cutter);
    find_radius();
    return true;
  }

  /// Lists the vertices outside, which are connected, starting from one of them.
  void find_outside_from(std::uint32_t first, const Cutter& cutter) {
    side_.resize(cell_.size(), 0);
    outside_.assign(1, first);
    inside_.clear();
    side_[first] = 1;
    for (std::size_t next = 0; next != outside_.size();) {  // it grows meanwhile
      const std::uint32_t v = outside_[next++];
      cell_.for_neighbors(v, [&](std::uint32_t u) {
        if (side_[u] != 0) return;
        int side = side_by_numbers(u, cutter);
        if (side == 0) side = is_outside_exactly(u, cutter) ? 1 : -1;
        side_[u] = static_cast<std::int8_t>(side);
        (side > 0 ? outside_ : inside_).push_back(u);
      });
    }
    for (const std::uint32_t v : outside_) side_[v] = 0;
    for (const std::uint32_t v : inside_) side_[v] = 0;
    std::sort(outside_.begin(), outside_.end());
  }

  /// Cuts off `outside_`.
  void cut(const Cutter& cutter) {
    if (cell_.cut(outside_, {cutter.border, plane_of(cutter.bisector)}, {exact_, radius_, false})) return;
    throw Error(ErrorCode::internal, "the cell of the seed at position " + std::to_string(rank_) +
                                         " of the Hilbert order could not be clipped without contradiction "
                                         "even on the host; please report the input");
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
  VertexSearch<double> vertex_search_;
  VertexSearch<TwoDoubles> close_search_;
  TieSets tie_sets_;
  Cell cell_;
  HostRegion region_;
  std::uint32_t rank_ = 0, region_number_ = 0;
  double radius_ = 0;  ///< no vertex is farther from the seed
  int exact_decisions_ = 0;
  std::vector<std::int8_t> side_;
  std::vector<std::uint32_t> outside_, inside_;
  std::vector<std::uint32_t> open_;  ///< vertices that may not be verified, or not be there any more
};

std::vector<std::array<double, 4>> pack(const Frame& frame, int dimension, std::span<const double> positions,
                                        std::span<const double> weights) {
  std::vector<std::array<double, 4>> points(positions.size() / static_cast<std::size_t>(dimension));
  static_assert(sizeof points[0] == Frame::point_bytes);
  frame.pack_to(reinterpret_cast<std::byte*>(points.data()), dimension, positions, weights, 1);
  return points;
}

}  // namespace

HostScene make_host_scene(const Scene& scene) {
  Frame frame = scene.frame();
  frame.split = false;  // differences of doubles need no shift, and scaling is exact
  frame.centre = {};
  const SeedSet& seeds = scene.seeds;
  const PackedTree& tree = scene.tree;
  const RegionMesh& mesh = scene.mesh();
  HostScene host{&mesh,
                 &tree,
                 pack(frame, mesh.dimension, mesh.vertices, {}),
                 pack(frame, seeds.dimension, seeds.positions, seeds.weights),
                 {},
                 regions_behind(mesh),
                 region_shape(mesh.shape)};
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
