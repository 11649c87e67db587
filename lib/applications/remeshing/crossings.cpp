// Pairs of triangles that cross each other.
#include <algorithm>

#include "lib/applications/remeshing/repair_steps.hpp"
#include "lib/base/box_tree.hpp"

namespace powercell::remeshing {
namespace {

using Triangle = std::array<Vec, 3>;

/// Whether the segment from p to q crosses the inside of a triangle, deeper than `depth`.
bool pierces(Vec p, Vec q, const Triangle& a, double depth) {
  const Vec n = unit(normal_of(a[0], a[1], a[2]));
  const double before = dot(n, p - a[0]), after = dot(n, q - a[0]);
  if (!((before > depth && after < -depth) || (before < -depth && after > depth))) return false;
  const Vec x = p + (q - p) * (before / (before - after));
  for (std::size_t k = 0; k < 3; ++k)
    if (!(dot(cross(n, unit(a[(k + 1) % 3] - a[k])), x - a[k]) > depth)) return false;
  return true;
}

bool cross_each_other(const Triangle& a, const Triangle& b, double depth) {
  for (std::size_t k = 0; k < 3; ++k)
    if (pierces(a[k], a[(k + 1) % 3], b, depth) || pierces(b[k], b[(k + 1) % 3], a, depth)) return true;
  return false;
}

}  // namespace

RepairCount crossings(const Patchwork& mesh, double rounding) {
  const auto corners = [&](std::uint32_t t) {
    return Triangle{mesh.vertex[mesh.row[t][0]], mesh.vertex[mesh.row[t][1]], mesh.vertex[mesh.row[t][2]]};
  };
  std::vector<Box> boxes(mesh.row.size());
  for (std::uint32_t t = 0; t < boxes.size(); ++t)
    for (const Vec& x : corners(t)) boxes[t].add(&x.x);
  const BoxTree tree(boxes);
  RepairCount found;
  for (std::uint32_t t = 0; t < boxes.size(); ++t)
    tree.for_each_meeting(boxes[t], [&](std::uint32_t s) {
      if (s >= t || !cross_each_other(corners(s), corners(t), rounding)) return;
      const Triangle a = corners(s), b = corners(t);
      count(found, (a[0] + a[1] + a[2] + b[0] + b[1] + b[2]) * (1.0 / 6));
    });
  return found;
}

}  // namespace powercell::remeshing
