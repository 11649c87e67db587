#include "tests/fuzz/treemap_laws.hpp"

#include <algorithm>
#include <cmath>

#include "tests/fuzz/targets.hpp"

namespace powercell::fuzz {
namespace {

long double area(const double* points, std::size_t count) {
  long double twice = 0;
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const auto edge = [&](std::size_t corner, int axis) {
      return static_cast<long double>(points[2 * corner + static_cast<std::size_t>(axis)]) - points[axis];
    };
    twice += edge(k, 0) * edge(k + 1, 1) - edge(k, 1) * edge(k + 1, 0);
  }
  return twice / 2;
}

long double farthest(const double* points, std::size_t count) {
  long double far = 0;
  for (std::size_t k = 0; k < 2 * count; ++k) far = std::max<long double>(far, std::fabs(points[k]));
  return far;
}

/// By how much of its area a polygon may change as its corners are rounded, which are computed in coordinates
/// of the outline.
/// \param far  of the outline's corners
long double rounding(const double* points, std::size_t count, long double far) {
  long double length = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double *const a = points + 2 * k, *const b = points + 2 * ((k + 1) % count);
    length += std::hypot(static_cast<long double>(b[0]) - a[0], static_cast<long double>(b[1]) - a[1]);
  }
  return 4 * 0x1p-53L * far * length / std::fabs(area(points, count));
}

/// Whether areas of a group's children are told to be off by as much as a missing one is.
bool told_off(const Treemap& map, std::int64_t group) {
  return map.worst_error >= 1 &&
         std::ranges::find(map.not_converged, static_cast<std::size_t>(group)) != map.not_converged.end();
}

}  // namespace

void check_treemap(const Treemap& map, std::span<const std::int64_t> parent, double tolerance) {
  const std::size_t n = parent.size();
  require(map.kind.size() == n && map.value.size() == n && map.depth.size() == n &&
              map.seeds.size() == 2 * n && map.vertex_offset.size() == n + 1 &&
              map.vertices.size() == 2 * map.vertex_offset.back(),
          "arrays of another size than the tree");
  long double leaves = 0, outline = 0;
  std::size_t root = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t begin = map.vertex_offset[i], count = map.vertex_offset[i + 1] - begin;
    const bool dropped = map.kind[i] == TreeNode::dropped;
    require(!dropped || count == 0, "a dropped node with a polygon");
    if (count == 0) {
      require(dropped || told_off(map, parent[i]),
              "a node without a polygon that is neither dropped nor told");
      continue;
    }
    require(count >= 3, "a polygon of less than three corners");
    require(map.value[i] > 0 && std::isfinite(map.value[i]), "a node with a polygon and without a value");
    for (std::size_t k = 2 * begin; k < 2 * (begin + count); ++k)
      require(std::isfinite(map.vertices[k]), "a corner that is not finite");
    const long double own = area(&map.vertices[2 * begin], count);
    if (map.kind[i] == TreeNode::leaf) leaves += own;
    if (parent[i] < 0) {
      outline = own;
      root = i;
    }
  }
  require(outline > 0, "an outline without area");
  require(std::fabs(leaves / outline - 1) < 1e-6L, "the leaves do not fill the outline");
  const double* const corners = &map.vertices[2 * map.vertex_offset[root]];
  const std::size_t corner_count = map.vertex_offset[root + 1] - map.vertex_offset[root];
  const long double far = farthest(corners, corner_count);
  for (std::size_t i = 0; i < n; ++i) {
    if (map.kind[i] != TreeNode::leaf) continue;
    const double* const points = &map.vertices[2 * map.vertex_offset[i]];
    const std::size_t count = map.vertex_offset[i + 1] - map.vertex_offset[i];
    if (count == 0) continue;
    const long double share = static_cast<long double>(map.value[i]) / map.value[root];
    const long double error = std::fabs(area(points, count) / outline / share - 1);
    const long double doubt = rounding(points, count, far) + rounding(corners, corner_count, far);
    require(error <= map.worst_error * (1 + 1e-12) + doubt, "an area further off than the worst");
    require(error <= tolerance + doubt || !map.not_converged.empty(), "areas beyond the tolerance");
  }
}

}  // namespace powercell::fuzz
