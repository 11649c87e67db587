/// \file
/// Tolerance for the difference between the two sides of a wall.
#pragma once

#include <string>

#include "lib/verify/rounding.hpp"

namespace powercell {

/// The allowed Adjacency::asymmetry (docs/mathematics.md, (18a)). A wall ends where its plane meets others,
/// so its ends move by the planes' rounding over the sine of the angle between them. The smallest of n random
/// angles is about 1/n, which sets the usual tolerance; where the asymmetry exceeds it, the angles of that
/// wall are computed. However small they are, no large wall may lack a side; where planes meet at right
/// angles, a wall of a few tens of roundings may.
/// \param adjacency  with ascending rows that list each wall from both sides
/// \param mesh  of the domain, null where it is not known
double allowed_asymmetry(const Adjacency& adjacency, const RegionMesh* mesh, const Rounding& rounding);

/// The message where it is exceeded.
std::string text_of_asymmetry(const Adjacency& adjacency);

}  // namespace powercell
