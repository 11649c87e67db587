/// \file
/// The triangles around a vertex of the new mesh, with the vertex moved. Internal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "lib/remeshing/work_mesh.hpp"

namespace powercell::remeshing {

constexpr double worst = std::numeric_limits<double>::infinity();  ///< cost of a triangle that must not be

/// Largest cost(a, b, c) of the triangles around v with v at `at`; `worst` where one turns over.
template <class Cost>
double cost_around(const WorkMesh& mesh, std::uint32_t v, Vec at, const Cost& cost) {
  double most = -worst;
  for (const std::uint32_t t : mesh.around(v)) {
    const WorkMesh::Row& row = mesh.triangle(t);
    std::array<Vec, 3> old{mesh.at(row[0]), mesh.at(row[1]), mesh.at(row[2])}, corner = old;
    for (std::size_t k = 0; k < 3; ++k)
      if (row[k] == v) corner[k] = at;
    const Vec before = normal_of(old[0], old[1], old[2]), after = normal_of(corner[0], corner[1], corner[2]);
    if (dot(before, after) <= 0.5 * norm(before) * norm(after)) return worst;
    most = std::max(most, cost(corner[0], corner[1], corner[2]));
    if (most == worst) return worst;
  }
  return most;
}

/// Of eight points at `length` around vertex v in its tangent plane the one of least cost, if below `least`.
template <class CostAt>
std::optional<Vec> best_around(const WorkMesh& mesh, const Surface& surface, std::uint32_t v, double length,
                               double least, const CostAt& cost) {
  const std::uint32_t t = mesh.vertex(v).place.triangle;
  const Vec n = unit(normal_of(surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2)));
  const Vec at = mesh.at(v), u = unit(std::fabs(n.x) < 0.7 ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0}));
  const Vec w = cross(n, u);
  std::optional<Vec> best;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4;
    const Vec to = at + u * (length * std::cos(angle)) + w * (length * std::sin(angle));
    const double here = cost(to);
    if (here >= least) continue;
    least = here;
    best = to;
  }
  return best;
}

}  // namespace powercell::remeshing
