#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/base/box_tree.hpp"
#include "lib/base/mesh_arrays.hpp"
#include "lib/base/positions.hpp"
#include "lib/base/random.hpp"
#include "lib/base/text.hpp"
#include "lib/domain/adjacency.hpp"
#include "lib/domain/build.hpp"
#include "lib/domain/measure.hpp"
#include "lib/domain/orientation.hpp"
#include "lib/domain/triangle_pairs.hpp"

namespace powercell {
namespace {

[[noreturn]] void refuse_solid(const std::string& why) {
  throw Error(ErrorCode::invalid_domain, why);
}

/// The closed surface of a solid. Corners are vertices, of those at one position the first.
class Shells {
 public:
  Shells(std::span<const double> vertices, std::span<const std::uint32_t> indices);

  /// Checks that every edge belongs to an even number of triangles, and joins those of two into patches, each
  /// with one orientation.
  void join_patches();
  void check_crossings() const;
  /// Turns the patches whose triangles have the inside on their outer side.
  void turn_patches();
  std::shared_ptr<RegionMesh> boundary() const;
  long double volume() const;

 private:
  /// An edge of two triangles with the same corners, and the places of both in the input.
  struct CommonEdge {
    std::array<std::uint32_t, 2> vertex, pair;
  };
  const double* at(std::uint32_t v) const { return &vertices_[3 * std::size_t{v}]; }
  std::string name(std::uint32_t row) const { return std::to_string(source_[row]); }
  std::string edge_text(const FacetKey<2>& edge) const {
    return "the edge from " + place_text(at(edge.vertex[0])) + " to " + place_text(at(edge.vertex[1]));
  }
  bool goes_up(std::uint32_t slot) const {
    return triangle_[slot / 3][slot % 3] < triangle_[slot / 3][(slot + 1) % 3];
  }
  void drop_common_faces();
  /// A pair of triangles with the same corners, left out, that has the edge; null if there is none.
  const std::array<std::uint32_t, 2>* repeated_at(const FacetKey<2>& edge) const {
    const auto found = std::lower_bound(common_edges_.begin(), common_edges_.end(), edge.vertex,
                                        [](const CommonEdge& a, const auto& b) { return a.vertex < b; });
    return found != common_edges_.end() && found->vertex == edge.vertex ? &found->pair : nullptr;
  }
  void check_edge(std::span<const FacetKey<2>> shared) const;
  std::uint32_t patch_of(std::uint32_t row);
  bool is_turned(std::uint32_t row) const;
  /// Whether a line along an axis, just beyond triangle `row`, crosses an even number of triangles on its way
  /// out.
  /// \return -1 if the line meets an edge
  int even_beyond(std::uint32_t row, std::size_t axis, const double* at_line) const;

  std::span<const double> vertices_;
  std::vector<Corners> triangle_;
  std::vector<std::uint32_t> source_, parent_, degenerate_;
  std::vector<std::array<std::uint32_t, 2>> repeated_;  ///< see MeshReport
  std::vector<CommonEdge> common_edges_;                ///< ascending
};

Shells::Shells(std::span<const double> vertices, std::span<const std::uint32_t> indices)
    : vertices_(vertices) {
  check_simplices(vertices, indices, 3, "triangle", "triangles");
  const std::vector<std::uint32_t> same = first_at_position(vertices, 3);
  for (std::uint32_t k = 0; k < indices.size(); k += 3) {
    const Corners c{same[indices[k]], same[indices[k + 1]], same[indices[k + 2]]};
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {  // its edges cancel
      degenerate_.push_back(k / 3);
      continue;
    }
    bool in_line = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<std::array<double, 2>, 3> flat;
      for (std::size_t v = 0; v < 3; ++v) flat[v] = {at(c[v])[axis], at(c[v])[(axis + 1) % 3]};
      in_line = in_line && orient2d(flat[0].data(), flat[1].data(), flat[2].data()) == 0;
    }
    if (in_line)
      refuse_solid("triangle " + std::to_string(k / 3) + " of the solid's surface is flat: its corners, at " +
                   place_text(at(c[0])) + ", " + place_text(at(c[1])) + " and " + place_text(at(c[2])) +
                   ", lie in a line; repair the surface first");
    triangle_.push_back(c);
    source_.push_back(k / 3);
  }
  if (triangle_.empty()) refuse_solid("the domain is empty: all triangles are degenerate");
  drop_common_faces();
  if (triangle_.empty())
    refuse_solid("the domain is empty: the surface is there twice; leave out the second copy");
  parent_.resize(triangle_.size());
  std::iota(parent_.begin(), parent_.end(), 0u);
}

/// Triangles with the same corners cancel in pairs, as where two bodies share a face: on both sides of it is
/// the inside, or the outside.
void Shells::drop_common_faces() {
  std::vector<std::pair<Corners, std::uint32_t>> rows;
  for (std::uint32_t row = 0; row < triangle_.size(); ++row) {
    rows.emplace_back(triangle_[row], row);
    std::sort(rows.back().first.begin(), rows.back().first.end());
  }
  std::sort(rows.begin(), rows.end());
  std::vector<bool> dropped(triangle_.size());
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    if (rows[k].first != rows[k + 1].first) continue;
    const auto& [c, first] = rows[k];
    const std::uint32_t second = rows[++k].second;
    dropped[first] = dropped[second] = true;
    repeated_.push_back({source_[second], source_[first]});
    for (const auto& [a, b] : {std::pair{c[0], c[1]}, {c[0], c[2]}, {c[1], c[2]}})
      common_edges_.push_back({{a, b}, repeated_.back()});
  }
  if (repeated_.empty()) return;
  std::sort(repeated_.begin(), repeated_.end());
  std::sort(common_edges_.begin(), common_edges_.end(),
            [](const CommonEdge& a, const CommonEdge& b) { return a.vertex < b.vertex; });
  std::size_t kept = 0;
  for (std::size_t row = 0; row < triangle_.size(); ++row) {
    if (dropped[row]) continue;
    triangle_[kept] = triangle_[row];
    source_[kept++] = source_[row];
  }
  triangle_.resize(kept);
  source_.resize(kept);
}

std::uint32_t Shells::patch_of(std::uint32_t row) {
  while (parent_[row] != row) row = parent_[row] = parent_[parent_[row]];
  return row;
}

void Shells::check_edge(std::span<const FacetKey<2>> shared) const {
  const std::uint32_t first = shared[0].slot / 3;
  const std::array<std::uint32_t, 2>* pair = repeated_at(shared[0]);
  if (shared.size() % 2 != 0 && pair != nullptr)
    refuse_solid("the surface of the solid is not closed: triangles " + std::to_string((*pair)[1]) + " and " +
                 std::to_string((*pair)[0]) + " at " + edge_text(shared[0]) +
                 " have the same corners, but are no face between two bodies; leave one of them out");
  if (shared.size() == 1)
    refuse_solid("the surface of the solid is open: only triangle " + name(first) + " has " +
                 edge_text(shared[0]));
  if (shared.size() % 2 != 0)
    refuse_solid("the surface of the solid is not closed: " + std::to_string(shared.size()) +
                 " triangles, of which the " + "first is " + name(first) + ", share " + edge_text(shared[0]) +
                 "; an even number can");
  if (shared.size() == 2 && goes_up(shared[0].slot) == goes_up(shared[1].slot) && pair == nullptr)
    refuse_solid("the surface of the solid is inside out in a part: triangles " + name(first) + " and " +
                 name(shared[1].slot / 3) + " at " + edge_text(shared[0]) +
                 " have opposite orientations; repair the surface first");
}

void Shells::join_patches() {
  std::vector<FacetKey<2>> edges(3 * triangle_.size());
  for (std::uint32_t slot = 0; slot < edges.size(); ++slot) {
    const auto [a, b] = std::minmax(triangle_[slot / 3][slot % 3], triangle_[slot / 3][(slot + 1) % 3]);
    edges[slot] = {{a, b}, slot};
  }
  for_each_shared(edges, [&](std::span<const FacetKey<2>> shared) {
    check_edge(shared);
    if (shared.size() == 2 && goes_up(shared[0].slot) != goes_up(shared[1].slot))
      parent_[patch_of(shared[1].slot / 3)] = patch_of(shared[0].slot / 3);
  });
  for (std::uint32_t row = 0; row < triangle_.size(); ++row) parent_[row] = patch_of(row);
}

void Shells::check_crossings() const {
  const std::optional<TrianglePair> pair = find_improper_pair(vertices_, triangle_);
  if (!pair) return;
  const bool two = parent_[pair->first] != parent_[pair->second];
  refuse_solid("the surface of the solid crosses or touches itself: triangles " + name(pair->first) +
               " and " + name(pair->second) + " have more in common around " +
               place_text(pair->place.data()) + " than a corner or an edge of both; " +
               (two ? "they are of two bodies: merge these into one surface (a boolean union in a mesh "
                      "program), or compute each body separately if they only touch"
                    : "repair the surface first"));
}

using Rational = boost::multiprecision::cpp_rational;

/// The coordinate along an axis at which a line along the axis meets the plane of a triangle.
Rational height(const std::array<const double*, 3>& t, std::size_t axis, const double* line) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  std::array<std::array<Rational, 3>, 2> edge;
  for (std::size_t e = 0; e < 2; ++e)
    for (std::size_t k = 0; k < 3; ++k) edge[e][k] = Rational(t[e + 1][k]) - Rational(t[0][k]);
  const auto normal = [&](std::size_t a, std::size_t b) {
    return Rational(edge[0][a] * edge[1][b] - edge[0][b] * edge[1][a]);
  };
  const Rational to_i = Rational(line[0]) - Rational(t[0][i]), to_j = Rational(line[1]) - Rational(t[0][j]);
  return Rational(t[0][axis]) - (normal(j, axis) * to_i + normal(axis, i) * to_j) / normal(i, j);
}

int Shells::even_beyond(std::uint32_t row, std::size_t axis, const double* line) const {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  const auto corners = [&](std::uint32_t r) {
    return std::array{at(triangle_[r][0]), at(triangle_[r][1]), at(triangle_[r][2])};
  };
  /// 1 if the line crosses the triangle, 0 if it passes it by, -1 if it meets an edge.
  const auto crosses = [&](const std::array<const double*, 3>& t) {
    const auto [low_i, high_i] = std::minmax({t[0][i], t[1][i], t[2][i]});
    const auto [low_j, high_j] = std::minmax({t[0][j], t[1][j], t[2][j]});
    if (line[0] < low_i || line[0] > high_i || line[1] < low_j || line[1] > high_j) return 0;
    std::array<int, 3> side{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<double, 2> a{t[k][i], t[k][j]}, b{t[(k + 1) % 3][i], t[(k + 1) % 3][j]};
      side[k] = orient2d(a.data(), b.data(), line);
    }
    const auto [least, most] = std::minmax({side[0], side[1], side[2]});
    return least * most < 0 ? 0 : least == most && least != 0 ? 1 : -1;
  };
  if (crosses(corners(row)) != 1) return -1;
  const Rational here = height(corners(row), axis, line);
  int even = 1;
  for (std::uint32_t r = 0; r < triangle_.size(); ++r) {
    if (r == row) continue;
    const int crossed = crosses(corners(r));
    if (crossed < 0) return -1;
    if (crossed > 0 && height(corners(r), axis, line) > here) even = 1 - even;
  }
  return even;
}

/// Looks from the middle of the triangle, or another point of it, along the axis nearest to its normal.
bool Shells::is_turned(std::uint32_t row) const {
  const std::array corner{at(triangle_[row][0]), at(triangle_[row][1]), at(triangle_[row][2])};
  const Vector n =
      cross(difference<long double>(corner[1], corner[0]), difference<long double>(corner[2], corner[0]));
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::fabs(n[k]) > std::fabs(n[axis])) axis = k;
  std::array<double, 3> share{1, 1, 1};
  std::mt19937_64 random(1);
  for (int attempt = 0; attempt < 1000; ++attempt) {
    std::array<double, 2> line{};
    const double sum = share[0] + share[1] + share[2];
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 2; ++k) line[k] += share[c] / sum * corner[c][(axis + 1 + k) % 3];
    const int even = even_beyond(row, axis, line.data());
    // Beyond an outward triangle there is the outside, and an even number of triangles before infinity.
    if (even >= 0) return (n[axis] > 0) != (even == 1);
    for (double& s : share) s = 0.1 + uniform(random);
  }
  refuse_solid("the orientation of the solid's surface could not be found at triangle " + name(row) +
               ", which is too narrow");
}

void Shells::turn_patches() {
  // The triangle of each patch that is largest as seen along an axis.
  std::vector<std::uint32_t> patch, best;
  std::vector<long double> size(triangle_.size(), -1);
  for (std::uint32_t row = 0; row < triangle_.size(); ++row) {
    const Corners& c = triangle_[row];
    const Vector n =
        cross(difference<long double>(at(c[1]), at(c[0])), difference<long double>(at(c[2]), at(c[0])));
    const long double seen = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
    if (size[parent_[row]] < 0) patch.push_back(parent_[row]);
    if (seen > size[parent_[row]]) {
      size[parent_[row]] = seen;
      best.resize(triangle_.size());
      best[parent_[row]] = row;
    }
  }
  std::vector<bool> turned(triangle_.size());
  for (const std::uint32_t p : patch) turned[p] = is_turned(best[p]);
  for (std::uint32_t row = 0; row < triangle_.size(); ++row)
    if (turned[parent_[row]]) std::swap(triangle_[row][1], triangle_[row][2]);
}

std::shared_ptr<RegionMesh> Shells::boundary() const {
  auto mesh = std::make_shared<RegionMesh>();
  mesh->kind = DomainKind::surface;
  mesh->dimension = 3;
  mesh->cell_dimension = 2;
  std::vector<std::uint32_t> number(vertices_.size() / 3, ~std::uint32_t{0});
  mesh->region_offset.push_back(0);
  for (const Corners& corners : triangle_) {
    for (const std::uint32_t v : corners) {
      if (number[v] == ~std::uint32_t{0}) {
        number[v] = static_cast<std::uint32_t>(mesh->vertices.size() / 3);
        mesh->vertices.insert(mesh->vertices.end(), at(v), at(v) + 3);
      }
      mesh->region_vertex.push_back(number[v]);
    }
    mesh->region_offset.push_back(static_cast<std::uint32_t>(mesh->region_vertex.size()));
  }
  mesh->facet_offset = mesh->region_offset;
  mesh->facet.assign(mesh->region_vertex.size(), {Border::Kind::boundary, 0});
  mesh->source = source_;
  mesh->report.flat = degenerate_;
  mesh->report.repeated = repeated_;
  return mesh;
}

long double Shells::volume() const {
  CompensatedSum<long double> sum;
  const double* const origin = at(triangle_[0][0]);
  for (const Corners& c : triangle_) {
    const Vector x = difference<long double>(at(c[0]), origin), y = difference<long double>(at(c[1]), origin),
                 z = difference<long double>(at(c[2]), origin);
    sum.add(dot(x, cross(y, z)) / 6);
  }
  return sum.value();
}

}  // namespace

RegionMeshPtr build_solid(std::span<const double> vertices, std::span<const std::uint32_t> triangles) {
  Shells shells(vertices, triangles);
  shells.join_patches();
  shells.check_crossings();
  shells.turn_patches();
  const std::shared_ptr<RegionMesh> boundary = shells.boundary();
  auto mesh = std::make_shared<RegionMesh>();
  mesh->kind = DomainKind::volume;
  mesh->dimension = mesh->cell_dimension = 3;
  mesh->shape = RegionShape::tetrahedron;
  mesh->region_offset = mesh->facet_offset = {0};
  mesh->boundary_count = static_cast<std::uint32_t>(boundary->region_count());
  mesh->report = boundary->report;
  CompensatedSum<long double> measure;
  measure.add(shells.volume());
  finish(*boundary, measure);
  mesh->measure = boundary->measure;
  mesh->low = boundary->low;
  mesh->high = boundary->high;
  mesh->solid_boundary = boundary;
  return mesh;
}

}  // namespace powercell
