/// \file
/// The boundary of a polygon domain as rings.
#pragma once

#include <array>
#include <powercell/domain.hpp>
#include <vector>

namespace powercell::io {

/// Chains of the boundary edges of a polygon domain, without those between its convex pieces; closed
/// (the last point is joined to the first). Unit and coordinates of the domain.
std::vector<Ring> boundary_rings(const Domain& domain);

}  // namespace powercell::io
