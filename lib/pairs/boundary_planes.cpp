#include "lib/pairs/boundary_planes.hpp"

#include <map>
#include <span>

#include "lib/base/disjoint_sets.hpp"
#include "lib/base/positions.hpp"
#include "lib/base/vectors.hpp"
#include "lib/domain/adjacency.hpp"
#include "lib/domain/orientation.hpp"

namespace powercell::pairs {
namespace {

using Vector = Vector3<double>;

/// With more planes, clipping by regions is cheaper.
constexpr std::size_t most_planes = 24;
/// Relative to the terms. Bounds the rounding of a determinant of differences of corners, and of a scalar
/// product with a cross product.
constexpr double rounding = 1e-14;

/// The side of vertex x, exactly: positive outside the plane of the facet a b c, counter-clockwise from
/// outside.
int side_of_plane(const std::vector<double>& vertices, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                  std::uint32_t x) {
  const auto at = [&](std::uint32_t v) { return &vertices[std::size_t{v} * 3]; };
  const Vector ab = difference<double>(at(b), at(a)), ac = difference<double>(at(c), at(a)),
               ax = difference<double>(at(x), at(a));
  const double value = dot(cross(ab, ac), ax);
  if (std::abs(value) > rounding * norm(ab) * norm(ac) * norm(ax)) return value > 0 ? 1 : -1;
  const std::uint32_t corners[4] = {a, b, c, x};
  return exact_orientation(vertices, corners);
}

/// Whether some vertex of the cell is inside all planes, so that they leave a part of it.
bool has_vertex_inside(const CellHull& cell, std::span<const LocalPlane> planes) {
  const std::size_t count = cell.vertex.size() / 3;
  for (std::size_t v = 0; v < count; ++v) {
    const Vector y = {cell.vertex[v], cell.vertex[count + v], cell.vertex[2 * count + v]};
    if (std::all_of(planes.begin(), planes.end(),
                    [&](const LocalPlane& p) { return dot(p.normal, y) < p.offset - 4 * cell.error; }))
      return true;
  }
  return false;
}

}  // namespace

BoundaryPlanes::BoundaryPlanes(const RegionMesh& boundary, const RegionGroups& groups)
    : mesh_(boundary),
      groups_(groups),
      blocks_(boundary, groups),
      vertex_(first_at_position(boundary.vertices, 3)),
      plane_(boundary.region_count()) {
  DisjointSets coplanar(plane_.size());
  const auto corners = [&](std::uint32_t f) { return &mesh_.region_vertex[std::size_t{f} * 3]; };
  const auto normal = [&](std::uint32_t f) {
    const auto at = [&](std::size_t k) { return &mesh_.vertices[std::size_t{corners(f)[k]} * 3]; };
    return cross(difference<double>(at(1), at(0)), difference<double>(at(2), at(0)));
  };
  struct Edge {
    std::uint32_t facet;
    std::size_t from;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Edge> edges;  // from, to
  for (std::uint32_t f = 0; f < plane_.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      edges[{vertex_[corners(f)[k]], vertex_[corners(f)[(k + 1) % 3]]}] = {f, k};
  for (const auto& [ends, edge] : edges) {
    const auto other = edges.find({ends.second, ends.first});
    if (other == edges.end() || ends.first > ends.second) continue;
    const std::uint32_t f = edge.facet, g = other->second.facet;
    const std::uint32_t *a = corners(f), x = corners(g)[(other->second.from + 2) % 3];
    // Coplanar triangles with a common edge have equal normals unless they are folded onto each other.
    if (side_of_plane(mesh_.vertices, a[0], a[1], a[2], x) == 0 && dot(normal(f), normal(g)) > 0)
      coplanar.unite(f, g);
  }
  for (std::uint32_t f = 0; f < plane_.size(); ++f) plane_[f] = coplanar.root(f);
}

const double* PlaneSearch::corner(std::uint32_t facet, std::size_t k) const {
  return &boundary_.mesh_
              .vertices[std::size_t{boundary_.mesh_.region_vertex[std::size_t{facet} * 3 + k]} * 3];
}

std::uint32_t PlaneSearch::vertex(std::uint32_t facet, std::size_t k) const {
  return boundary_.vertex_[boundary_.mesh_.region_vertex[std::size_t{facet} * 3 + k]];
}

/// Whether a facet meets the box of the cell, by the thirteen possible separating axes of a triangle and a
/// box.
PlaneSearch::Meeting PlaneSearch::meets_box(std::uint32_t facet, const double* seed,
                                            const CellHull& cell) const {
  Vector middle, half, x[3];
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = (cell.low[k] + cell.high[k]) / 2;
    half[k] = (cell.high[k] - cell.low[k]) / 2;
    for (std::size_t c = 0; c < 3; ++c) x[c][k] = corner(facet, c)[k] - seed[k] - middle[k];
  }
  bool clear = true;
  const auto separated = [&](const Vector& axis) {
    double low = dot(axis, x[0]), high = low, radius = 0, terms = 0;
    for (const Vector& corner : x) {
      low = std::min(low, dot(axis, corner));
      high = std::max(high, dot(axis, corner));
      for (std::size_t k = 0; k < 3; ++k)
        terms += std::abs(axis[k]) * (std::abs(corner[k]) + std::abs(seed[k]) + std::abs(middle[k]));
    }
    for (std::size_t k = 0; k < 3; ++k) radius += std::abs(axis[k]) * half[k];
    const double gap = std::max(low, -high) - radius, error = rounding * (terms + radius);
    // The axis is 0 for an edge along a coordinate axis; it separates nothing.
    if (std::abs(gap) <= error && radius > 0) clear = false;
    return gap > error;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    Vector axis{};
    axis[k] = 1;
    if (separated(axis)) return Meeting::none;
  }
  const Vector edge[3] = {difference<double>(x[1].data(), x[0].data()),
                          difference<double>(x[2].data(), x[1].data()),
                          difference<double>(x[0].data(), x[2].data())};
  if (separated(cross(edge[0], edge[1]))) return Meeting::none;
  for (const Vector& e : edge)
    for (std::size_t k = 0; k < 3; ++k) {
      Vector axis{};
      axis[k] = 1;
      if (separated(cross(axis, e))) return Meeting::none;
    }
  return clear ? Meeting::some : Meeting::unclear;
}

/// Appends the facets of a group that meet the cell's box to near_. Returns false if one is unclear.
bool PlaneSearch::gather(std::size_t level, std::size_t group, const double* seed, const CellHull& cell) {
  if (level == 0) {
    const std::uint32_t facet = boundary_.groups_.order[group];
    const Meeting meeting = meets_box(facet, seed, cell);
    if (meeting == Meeting::some) near_.push_back(facet);
    return meeting != Meeting::unclear;
  }
  const std::size_t below = boundary_.groups_.level[level - 1].low.size() / 3;
  const std::size_t members = std::min(RegionGroups::fan, below - group * RegionGroups::fan);
  Lanes gap;
  boundary_.blocks_.find_gaps(level - 1, group, seed, cell.low.data(), cell.high.data(), gap);
  for (std::size_t lane = 0; lane < members; ++lane)
    // Boxes that touch to within rounding count as overlapping.
    if (!(gap[lane] > cell.error) && !gather(level - 1, group * RegionGroups::fan + lane, seed, cell))
      return false;
  return true;
}

/// Sets in_plane_ to the vertices of the near facets in a plane.
void PlaneSearch::gather_vertices(std::uint32_t plane) {
  in_plane_.clear();
  for (const std::uint32_t f : near_)
    if (boundary_.plane_[f] == plane)
      for (std::size_t k = 0; k < 3; ++k) in_plane_.push_back(vertex(f, k));
  std::sort(in_plane_.begin(), in_plane_.end());
}

/// The side of a facet's corner k, exactly. \pre gather_vertices(plane)
int PlaneSearch::side(std::uint32_t plane, std::uint32_t facet, std::size_t k) const {
  if (std::binary_search(in_plane_.begin(), in_plane_.end(), vertex(facet, k))) return 0;
  const std::uint32_t* a = &boundary_.mesh_.region_vertex[std::size_t{plane} * 3];
  return side_of_plane(boundary_.mesh_.vertices, a[0], a[1], a[2],
                       boundary_.mesh_.region_vertex[std::size_t{facet} * 3 + k]);
}

/// Whether (12c) holds: each facet lies inside all planes of the others, and in none of them.
bool PlaneSearch::convex_around() {
  if (plane_.size() < 2) return true;
  for (const std::uint32_t plane : plane_) {
    gather_vertices(plane);
    for (const std::uint32_t facet : near_) {
      if (boundary_.plane_[facet] == plane) continue;
      bool within = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const int s = side(plane, facet, k);
        if (s > 0) return false;
        within = within && s == 0;
      }
      if (within) return false;
    }
  }
  return true;
}

LocalPlane PlaneSearch::plane_of(std::uint32_t facet, const double* seed, double reach) const {
  const Vector a = difference<double>(corner(facet, 1), corner(facet, 0)),
               b = difference<double>(corner(facet, 2), corner(facet, 0)),
               y = difference<double>(corner(facet, 0), seed), n = cross(a, b);
  const double size = norm(n);
  LocalPlane plane;
  for (std::size_t k = 0; k < 3; ++k) plane.normal[k] = n[k] / size;
  plane.offset = dot(plane.normal, y);
  reach += std::abs(y[0]) + std::abs(y[1]) + std::abs(y[2]);
  plane.error = 16 * std::numeric_limits<double>::epsilon() * reach * (norm(a) * norm(b) / size);
  return plane;
}

PlaneSearch::Found PlaneSearch::find(const double* seed, const CellHull& cell,
                                     std::vector<LocalPlane>& planes) {
  if (cell.empty() || boundary_.plane_.empty()) return Found::unclear;
  near_.clear();
  plane_.clear();
  if (!gather(boundary_.groups_.level.size() - 1, 0, seed, cell)) return Found::unclear;
  for (const std::uint32_t facet : near_)
    if (std::find(plane_.begin(), plane_.end(), boundary_.plane_[facet]) == plane_.end()) {
      if (plane_.size() == most_planes) return Found::unclear;
      plane_.push_back(boundary_.plane_[facet]);
    }
  if (plane_.empty()) return Found::nothing;
  if (!convex_around()) return Found::unclear;
  const std::size_t begin = planes.size();
  double reach = 0;
  for (std::size_t k = 0; k < 3; ++k) reach += std::max(std::abs(cell.low[k]), std::abs(cell.high[k]));
  for (const std::uint32_t first : plane_) {
    LocalPlane best{};
    best.error = std::numeric_limits<double>::infinity();
    for (const std::uint32_t facet : near_) {
      if (boundary_.plane_[facet] != first) continue;
      const LocalPlane plane = plane_of(facet, seed, reach);
      if (plane.error < best.error) best = plane;
    }
    if (!(best.error < cell.error)) {  // nearly degenerate facets
      planes.resize(begin);
      return Found::unclear;
    }
    planes.push_back(best);
  }
  if (has_vertex_inside(cell, std::span(planes).subspan(begin))) return Found::planes;
  planes.resize(begin);
  return Found::unclear;
}

}  // namespace powercell::pairs
