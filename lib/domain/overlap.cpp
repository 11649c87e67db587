#include "lib/domain/overlap.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "lib/base/box_tree.hpp"
#include "lib/domain/common_part.hpp"
#include "lib/domain/coplanar.hpp"

namespace powercell {
namespace {

using Point = Vector3<double>;

template <std::size_t N>
std::array<Point, N> corners_of(const RegionMesh& mesh, std::uint32_t region) {
  std::array<Point, N> corner;
  for (std::size_t c = 0; c < N; ++c) {
    const double* at = &mesh.vertices[3 * std::size_t{mesh.region_vertex[N * region + c]}];
    corner[c] = {at[0], at[1], at[2]};
  }
  return corner;
}

template <std::size_t N>
Box box_of(const std::array<Point, N>& corner) {
  Box box;
  for (const Point& x : corner) box.add(x.data());
  return box;
}

template <std::size_t N>
std::array<Vector, N> widened(const std::array<Point, N>& corner) {
  std::array<Vector, N> wide;
  for (std::size_t c = 0; c < N; ++c) wide[c] = {corner[c][0], corner[c][1], corner[c][2]};
  return wide;
}

template <std::size_t N>
double longest_edge(const std::array<Point, N>& corner) {
  double most = 0;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < i; ++j) most = std::max(most, norm(corner[i] - corner[j]));
  return most;
}

/// An open facet of a region: its corners, a plane through it, at right angles to the region, and the normal
/// of that plane.
template <std::size_t N>
struct OpenFacet {
  std::uint32_t region;
  std::array<Point, N - 1> corner;
  Point outwards;
};

double size(const Point& n) {
  return std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
}

OpenFacet<4> facet_of(const std::array<Point, 4>& a, std::uint32_t region, std::size_t k) {
  const auto& f = tetrahedron_facet[k];
  return {region, {a[f[0]], a[f[1]], a[f[2]]}, cross(a[f[1]] - a[f[0]], a[f[2]] - a[f[0]])};
}

OpenFacet<3> facet_of(const std::array<Point, 3>& a, std::uint32_t region, std::size_t k) {
  const Point n = cross(a[1] - a[0], a[2] - a[0]);
  return {region, {a[k], a[(k + 1) % 3]}, cross(a[(k + 1) % 3] - a[k], n)};
}

/// Whether some facet of a region has all points on its outer side, or not deeper than `depth` in the region.
template <std::size_t N, std::size_t M>
bool apart_by_facet(const std::array<Point, N>& a, const std::array<Point, M>& points, double depth) {
  for (std::size_t k = 0; k < N; ++k) {
    const OpenFacet<N> facet = facet_of(a, 0, k);
    const double least = -depth * size(facet.outwards);
    if (std::all_of(points.begin(), points.end(),
                    [&](const Point& x) { return dot(facet.outwards, x - facet.corner[0]) >= least; }))
      return true;
  }
  return false;
}

/// Whether a region can overlap that of an open facet at the facet: it is on both sides of it, or has a facet
/// of its own there and lies on the same side.
template <std::size_t N>
bool may_overlap(const OpenFacet<N>& facet, const std::array<Point, N>& b, double depth) {
  const double touching = depth * size(facet.outwards);
  std::size_t inside = 0, outside = 0;
  for (const Point& x : b) {
    const double side = dot(facet.outwards, x - facet.corner[0]);
    inside += side < -touching;
    outside += side > touching;
  }
  if (inside == 0) return false;
  if (outside == 0) return inside == 1;
  return !apart_by_facet(b, facet.corner, depth);
}

/// What two tetrahedra have in common beyond rounding; measure 0 if nothing.
CommonPart overlap(const std::array<Point, 4>& a, const std::array<Point, 4>& b, double depth) {
  const Box in = box_of(a), out = box_of(b);
  for (std::size_t k = 0; k < 3; ++k)
    if (std::min(in.high[k], out.high[k]) - std::max(in.low[k], out.low[k]) <= depth) return {};
  if (apart_by_facet(a, b, depth) || apart_by_facet(b, a, depth)) return {};
  const CommonPart part = common_part(widened(a), widened(b));
  const double width = std::min(longest_edge(a), longest_edge(b));
  return part.measure > depth * width * width ? part : CommonPart{};
}

/// The same of two triangles; those that are not in one plane have nothing in common.
CommonPart overlap(const std::array<Point, 3>& a, const std::array<Point, 3>& b, double depth) {
  if (!in_plane_of(a, b, depth) && !in_plane_of(b, a, depth)) return {};
  if (apart_by_facet(a, b, depth) || apart_by_facet(b, a, depth)) return {};
  const CommonPart part = common_part(widened(a), widened(b));
  return part.measure > depth * std::min(longest_edge(a), longest_edge(b)) ? part : CommonPart{};
}

/// Appends two regions to `found` if they overlap.
template <std::size_t N>
void try_pair(const RegionMesh& mesh, std::uint32_t a, std::uint32_t b, double depth,
              std::vector<Overlap>& found) {
  const CommonPart part = overlap(corners_of<N>(mesh, a), corners_of<N>(mesh, b), depth);
  if (part.measure == 0) return;
  const auto [first, second] = std::minmax(mesh.source[a], mesh.source[b]);
  found.push_back({first, second, static_cast<double>(part.measure), {}});
  for (std::size_t d = 0; d < 3; ++d) found.back().at[d] = static_cast<double>(part.centroid[d]);
}

/// Appends the pairs of a region with an open facet and one of `all` that overlap at the facet.
template <std::size_t N>
void try_pairs(const RegionMesh& mesh, const std::vector<OpenFacet<N>>& open,
               std::span<const std::uint32_t> all, std::vector<Overlap>& found) {
  if (open.empty()) return;
  const double depth = touching_depth(mesh);
  std::vector<Box> boxes;
  for (const OpenFacet<N>& facet : open) boxes.push_back(box_of(facet.corner));
  const BoxTree tree(boxes);
  const BoxGrid grid(boxes);
  for (const std::uint32_t r : all) {
    const std::array<Point, N> corner = corners_of<N>(mesh, r);
    const Box box = box_of(corner);
    if (!grid.may_meet(box)) continue;
    tree.for_each_meeting(box, [&](std::uint32_t k) {
      if (open[k].region != r && may_overlap(open[k], corner, depth))
        try_pair<N>(mesh, open[k].region, r, depth, found);
    });
  }
}

void report(std::vector<Overlap> found, MeshReport& report) {
  const auto pair = [](const Overlap& o) { return std::pair(o.first, o.second); };
  std::sort(found.begin(), found.end(),
            [&](const Overlap& a, const Overlap& b) { return pair(a) < pair(b); });
  const auto again = std::unique(found.begin(), found.end(),  // where both are open
                                 [&](const Overlap& a, const Overlap& b) { return pair(a) == pair(b); });
  found.erase(again, found.end());
  CompensatedSum<long double> sum;
  for (const Overlap& o : found) {
    sum.add(o.measure);
    if (o.measure > report.largest.measure) report.largest = o;
  }
  report.overlaps = found.size();
  report.overlap = sum.value();
}

std::vector<std::uint32_t> all_regions(const RegionMesh& mesh) {
  std::vector<std::uint32_t> all(mesh.region_count());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/// Appends the overlaps of some triangles with any of `all`.
void try_triangles(const RegionMesh& mesh, std::span<const std::uint32_t> some,
                   std::span<const std::uint32_t> all, std::vector<Overlap>& found) {
  const double depth = touching_depth(mesh);
  std::vector<OpenFacet<3>> open;
  for (const std::uint32_t r : some) {
    const std::array<Point, 3> corner = corners_of<3>(mesh, r);
    const std::array<bool, 3> closed = continued(mesh, r, corner, depth);
    for (std::size_t k = 0; k < 3; ++k)
      if (!closed[k]) open.push_back(facet_of(corner, r, k));
  }
  try_pairs(mesh, open, all, found);
}

/// Appends the overlaps among triangles that may lie in one plane.
void try_plane(const RegionMesh& mesh, std::span<const std::uint32_t> in_plane, std::vector<Overlap>& found) {
  constexpr std::size_t few = 8;  // are faster tried one by one
  if (in_plane.size() > few) return try_triangles(mesh, in_plane, in_plane, found);
  for (std::size_t i = 0; i < in_plane.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      try_pair<3>(mesh, in_plane[i], in_plane[j], touching_depth(mesh), found);
}

}  // namespace

double touching_depth(const RegionMesh& mesh) {
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    largest = std::max({largest, std::fabs(mesh.low[k]), std::fabs(mesh.high[k])});
  return 0x1p-50 * largest;
}

void find_overlapping_tetrahedra(RegionMesh& mesh) {
  std::vector<OpenFacet<4>> open;
  for (std::uint32_t r = 0; r < mesh.region_count(); ++r)
    for (std::size_t k = 0; k < 4; ++k)
      if (mesh.facet[4 * r + k].kind == Border::Kind::boundary)
        open.push_back(facet_of(corners_of<4>(mesh, r), r, k));
  std::vector<Overlap> found;
  try_pairs(mesh, open, all_regions(mesh), found);
  report(std::move(found), mesh.report);
}

void find_overlapping_triangles(RegionMesh& mesh) {
  std::vector<Overlap> found;
  const std::vector<std::uint32_t> uncertain =
      for_each_plane(mesh, touching_depth(mesh),
                     [&](std::span<const std::uint32_t> in_plane) { try_plane(mesh, in_plane, found); });
  if (!uncertain.empty()) try_triangles(mesh, uncertain, all_regions(mesh), found);
  report(std::move(found), mesh.report);
}

}  // namespace powercell
