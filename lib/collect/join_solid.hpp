/// \file
/// The geometry of the cells in a solid.
#pragma once

#include <cstdint>
#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/collect/coincident_walls.hpp"
#include "lib/domain/frame.hpp"
#include "lib/seeds/seed_set.hpp"
#include "lib/solid/cell_faces.hpp"

namespace powercell {

/// The surface of a cell that the boundary meets, in device units.
struct CellAtBoundary {
  std::uint32_t rank;
  const solid::CellFaces* faces;
};

struct SolidGeometry {
  JoinedCells joined;
  /// Rows of four seeds whose cells meet in a point inside; with repetitions, seeds in any order.
  std::vector<std::uint32_t> simplices;
};

struct SolidGeometryInput {
  const Domain& domain;
  const Cells& whole;                           ///< the cells that lie inside as wholes, one piece each
  std::span<const CellAtBoundary> at_boundary;  ///< all others
  std::vector<CoincidentWall> coincident;       ///< in seeds of the caller
  const SeedSet& seeds;
  const Frame& frame;
  const std::vector<SeedStatus>& status;
};

SolidGeometry join_solid(const SolidGeometryInput& input);

}  // namespace powercell
