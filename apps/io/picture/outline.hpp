/// \file
/// The boundary of a polygon domain as rings.
#pragma once

#include <array>
#include <powercell/domain.hpp>
#include <vector>

namespace powercell::io {

/// Closed chains of the boundary edges of a polygon domain, without the edges between its convex pieces; the
/// last point is joined to the first. Coordinates of the domain.
std::vector<Ring> boundary_rings(const Domain& domain);

}  // namespace powercell::io
