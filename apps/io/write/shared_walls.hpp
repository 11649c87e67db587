/// \file
/// The faces of polyhedra that share points, each wall once.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/io/write/output.hpp"
#include "apps/io/write/shared_points.hpp"

namespace powercell::io {

struct SharedWall {
  std::vector<std::uint32_t> loop;  ///< points, counter-clockwise seen from outside of `cell`
  std::uint32_t cell;
  Border border;  ///< no other than wall and boundary
  std::array<std::int32_t, 3> shift{};
};

/// The faces of the cells of a volume, ordered by cell. A wall within the domain is that of the cell of the
/// lower seed. Its parts in several regions are joined where they form one polygon without holes.
std::vector<SharedWall> shared_walls(const DiagramOutput& output, const SharedPoints& points);

}  // namespace powercell::io
