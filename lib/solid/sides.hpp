/// \file
/// On which side of the boundary cells lie whose edges it does not cross.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lib/solid/solid_cells.hpp"

namespace powercell {

struct SidesInput {
  /// By rank: whether all vertices of the cell lie on one side, because the boundary crosses none of its
  /// edges.
  const std::vector<bool>& one_sided;
  const SideHints& hints;
  std::function<std::span<const std::uint32_t>(std::uint32_t)> neighbors;  ///< of a one-sided cell
  std::span<const std::uint32_t> outer;  ///< ranks of cells with vertices outside
};

/// The side of each one-sided cell; unknown for others, and for all if some contradict each other. One-sided
/// neighbours lie on the same side, as they share vertices. A neighbour of which a cell has seen nothing lies
/// outside: their wall is beyond the box that the cell was clipped in, and there the solid has no part in it
/// (docs/mathematics.md, "Solids by their boundary").
std::vector<solid::Side> find_sides(const SidesInput& input);

}  // namespace powercell
