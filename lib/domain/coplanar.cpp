#include "lib/domain/coplanar.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lib/base/radix_sort.hpp"

namespace powercell {
namespace {

using Point = Vector3<double>;
using Triangle = std::array<Point, 3>;

Triangle corners_of(const RegionMesh& mesh, std::uint32_t region) {
  Triangle corner;
  for (std::size_t c = 0; c < 3; ++c) {
    const double* at = &mesh.vertices[3 * std::size_t{mesh.region_vertex[3 * region + c]}];
    corner[c] = {at[0], at[1], at[2]};
  }
  return corner;
}

double size(const Point& n) {
  return std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
}

/// Marks of the plane of a triangle, one, or up to four near the border between two. Planes that differ by
/// rounding have one in common, others seldom do. They come from two numbers that do not depend on the
/// orientation of the plane.
/// \param reach  the largest magnitude of a coordinate
/// \return their number, 0 if rounding of coordinates by `depth` leaves the plane too uncertain
std::size_t marks_of(const Triangle& a, double reach, double depth, std::array<std::uint64_t, 4>& mark) {
  const Point ab = a[1] - a[0], bc = a[2] - a[1], ca = a[0] - a[2], n = cross(ab, bc);
  const double length2 = dot(n, n), longest2 = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)});
  if (!(depth * depth * longest2 < 0x1p-64 * length2)) return 0;
  const double offset = dot(n, a[0]) / (length2 * reach);
  const double numbers[2] = {
      (0.3 * n[0] * n[0] - 0.4 * n[1] * n[1] + 0.17 * n[0] * n[1] + 0.23 * n[1] * n[2] - 0.29 * n[2] * n[0]) /
          length2,
      offset * (0.31 * n[0] + 0.43 * n[1] + 0.57 * n[2])};
  std::int64_t cell[2], other[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const double scaled = numbers[k] * 0x1p22, floor = std::floor(scaled);
    cell[k] = other[k] = static_cast<std::int64_t>(floor);
    if (scaled - floor < 0x1p-6) --other[k];
    if (scaled - floor > 1 - 0x1p-6) ++other[k];
  }
  std::size_t count = 0;
  for (std::size_t x = 0; x < (other[0] == cell[0] ? 1 : 2); ++x)
    for (std::size_t y = 0; y < (other[1] == cell[1] ? 1 : 2); ++y) {
      const auto u = static_cast<std::uint64_t>(x == 0 ? cell[0] : other[0]),
                 v = static_cast<std::uint64_t>(y == 0 ? cell[1] : other[1]);
      mark[count++] = (u << 32 ^ (v & 0xffffffff)) * 0x9e3779b97f4a7c15u;
    }
  return count;
}

}  // namespace

bool in_plane_of(const Triangle& a, const Triangle& b, double depth) {
  const Point n = cross(a[1] - a[0], a[2] - a[0]);
  const double most = depth * size(n);
  return std::all_of(b.begin(), b.end(), [&](const Point& x) { return std::fabs(dot(n, x - a[0])) <= most; });
}

std::array<bool, 3> continued(const RegionMesh& mesh, std::uint32_t region, const Triangle& a, double depth) {
  const Point n = cross(a[1] - a[0], a[2] - a[0]);
  const double most = depth * size(n);
  std::array<bool, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Border border = mesh.facet[3 * region + k];
    if (border.kind == Border::Kind::boundary) continue;
    const Border* behind = &mesh.facet[3 * border.index];
    const bool only = std::any_of(behind, behind + 3, [&](const Border& b) {
      return b.kind == Border::Kind::interior && b.index == region;
    });
    if (!only) continue;
    const Point &p = a[k], &q = a[(k + 1) % 3], outwards = cross(q - p, n);
    const Triangle b = corners_of(mesh, border.index);
    result[k] = std::all_of(b.begin(), b.end(), [&](const Point& x) {
      return x == p || x == q || (dot(outwards, x - p) > 0 && std::fabs(dot(n, x - p)) <= most);
    });
  }
  return result;
}

std::vector<std::uint32_t> for_each_plane(const RegionMesh& mesh, double depth,
                                          const std::function<void(std::span<const std::uint32_t>)>& group) {
  std::vector<KeyedIndex> marked;
  std::vector<std::uint32_t> uncertain, run;
  marked.reserve(mesh.region_count() + mesh.region_count() / 8);
  std::array<std::uint64_t, 4> mark{};
  for (std::uint32_t r = 0; r < mesh.region_count(); ++r) {
    const std::size_t count = marks_of(corners_of(mesh, r), depth * 0x1p50, depth, mark);
    for (std::size_t k = 0; k < count; ++k) marked.push_back({mark[k], r});
    if (count == 0) uncertain.push_back(r);
  }
  std::vector<KeyedIndex> scratch(marked.size());
  sort_by_key(marked, scratch, 1);
  for (auto first = marked.cbegin(); first != marked.cend();) {
    auto last = first + 1;
    while (last != marked.cend() && last->key == first->key) ++last;
    if (last - first > 1) {
      run.clear();
      std::transform(first, last, std::back_inserter(run), [](const KeyedIndex& k) { return k.index; });
      group(run);
    }
    first = last;
  }
  return uncertain;
}

}  // namespace powercell
