/// \file
/// The steps of repair().
#pragma once

#include <array>
#include <cstdint>
#include <powercell/repair.hpp>
#include <span>
#include <vector>

#include "lib/applications/remeshing/vec.hpp"

namespace powercell::remeshing {

using Rows = std::vector<std::array<std::uint32_t, 3>>;

/// A mesh under repair. Half-edge 3t+k goes from corner k of triangle t to the next one.
struct Patchwork {
  std::vector<Vec> vertex;
  Rows row;

  std::uint32_t from(std::uint32_t half_edge) const { return row[half_edge / 3][half_edge % 3]; }
  std::uint32_t to(std::uint32_t half_edge) const { return row[half_edge / 3][(half_edge + 1) % 3]; }
  std::uint32_t apex(std::uint32_t half_edge) const { return row[half_edge / 3][(half_edge + 2) % 3]; }
  Vec middle(std::uint32_t half_edge) const {
    return (vertex[from(half_edge)] + vertex[to(half_edge)]) * 0.5;
  }
};

Patchwork patchwork_of(std::span<const double> vertices, std::span<const std::uint32_t> triangles);

inline void count(RepairCount& what, Vec at) {
  if (what.count++ == 0) what.first = {at.x, at.y, at.z};
}

/// Removes degenerate and repeated triangles.
/// \param same  per vertex: the first at its position
void drop_doubles(Patchwork& mesh, std::span<const std::uint32_t> same, RepairReport& report);

/// Joins the edges of triangles in pairs, orients the triangles and makes the vertices that follow.
void join_edges(Patchwork& mesh, std::span<const std::uint32_t> same, double weld, RepairReport& report);

/// Removes triangles whose height is within the rounding of coordinates, and those with an edge up to `tiny`
/// long.
/// \pre an oriented manifold
void remove_flat(Patchwork& mesh, double rounding, double tiny, RepairReport& report);

/// Counts pairs of triangles that cross, beyond rounding; not those that touch or overlap in a plane.
RepairCount crossings(const Patchwork& mesh, double rounding);

}  // namespace powercell::remeshing
