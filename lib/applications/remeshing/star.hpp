/// \file
/// Costs of the triangles around a vertex of the new mesh when the vertex moves.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "lib/applications/remeshing/work_mesh.hpp"

namespace powercell::remeshing {

constexpr double worst = std::numeric_limits<double>::infinity();  ///< cost of a forbidden triangle

/// Whether a triangle, with its corner v at `to`, faces against the surface normals at its free corners. Kept
/// corners are ignored, as they lie on edges between two sides.
inline bool faces_inwards(const WorkMesh& mesh, const Surface& surface, const WorkMesh::Corners& row,
                          std::uint32_t v = nothing, const Place& to = {}) {
  std::array<Vec, 3> corner;
  Vec outwards;
  for (std::size_t k = 0; k < 3; ++k) {
    const Place& place = row[k] == v ? to : mesh.vertex(row[k]).place;
    corner[k] = place.at;
    if (mesh.vertex(row[k]).kind == Hold::Kind::free) outwards += surface.normal(place.triangle);
  }
  if (outwards == Vec{}) return false;
  return !(dot(normal_of(corner[0], corner[1], corner[2]), outwards) > 0);
}

/// Whether a triangle turns over when it becomes `after`, with corner v at `to`: by a large angle at once,
/// or, since small ones add up, against the surface.
inline bool turns_over(const WorkMesh& mesh, const Surface& surface, const WorkMesh::Corners& row,
                       const WorkMesh::Corners& after, std::uint32_t v = nothing, const Place& to = {}) {
  const auto at = [&](std::size_t k) { return after[k] == v ? to.at : mesh.at(after[k]); };
  const Vec old = normal_of(mesh.at(row[0]), mesh.at(row[1]), mesh.at(row[2]));
  const Vec normal = normal_of(at(0), at(1), at(2));
  if (!(dot(old, normal) > 0.5 * norm(old) * norm(normal))) return true;
  return faces_inwards(mesh, surface, after, v, to) && !faces_inwards(mesh, surface, row);
}

/// Whether a flip of two triangles that face outwards makes one that faces inwards.
inline bool flips_inwards(const WorkMesh& mesh, const Surface& surface, const WorkMesh::Edge& e) {
  const auto inwards = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return faces_inwards(mesh, surface, {a, b, c});
  };
  return (inwards(e.a, e.d, e.c) || inwards(e.d, e.b, e.c)) && !inwards(e.a, e.b, e.c) &&
         !inwards(e.b, e.a, e.d);
}

/// The largest cost(a, b, c) of the triangles around v with v at `to`; `worst` if one turns over.
template <class Cost>
double cost_around(const WorkMesh& mesh, const Surface& surface, std::uint32_t v, const Place& to,
                   const Cost& cost) {
  double most = -worst;
  for (const std::uint32_t t : mesh.around(v)) {
    const WorkMesh::Corners& row = mesh.triangle(t);
    std::array<Vec, 3> corner{mesh.at(row[0]), mesh.at(row[1]), mesh.at(row[2])};
    for (std::size_t k = 0; k < 3; ++k)
      if (row[k] == v) corner[k] = to.at;
    if (turns_over(mesh, surface, row, row, v, to)) return worst;
    most = std::max(most, cost(corner[0], corner[1], corner[2]));
    if (most == worst) return worst;
  }
  return most;
}

/// The point of least cost among eight points at the distance `length` from vertex v in its tangent plane, if
/// that cost is below `least`.
/// \param cost  cost of v at a place, which need not be on the surface
template <class CostAt>
std::optional<Vec> best_around(const WorkMesh& mesh, const Surface& surface, std::uint32_t v, double length,
                               double least, const CostAt& cost) {
  const std::uint32_t t = mesh.vertex(v).place.triangle;
  const Vec n = surface.normal(t);
  const Vec at = mesh.at(v), u = unit(std::fabs(n.x) < 0.7 ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0}));
  const Vec w = cross(n, u);
  std::optional<Vec> best;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4;
    const Vec to = at + u * (length * std::cos(angle)) + w * (length * std::sin(angle));
    const double here = cost(Place{t, to});
    if (here >= least) continue;
    least = here;
    best = to;
  }
  return best;
}

}  // namespace powercell::remeshing
