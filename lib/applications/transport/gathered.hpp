/// \file
/// Images of the seeds of a periodic domain that are near each other.
#pragma once

#include <powercell/domain.hpp>
#include <span>
#include <vector>

namespace powercell {

/// Positions moved by whole periods so that along each of these the widest gap between seeds is outside:
/// clusters at the faces of a periodic box are in one piece. In other domains, positions as they are.
/// \param positions  n x dimension
std::vector<double> gathered(const Domain& domain, std::span<const double> positions);

}  // namespace powercell
