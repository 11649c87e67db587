/// \file
/// How far the two sides of a wall may be apart. Internal.
#pragma once

#include <string>

#include "lib/verify/rounding.hpp"

namespace powercell {

/// What Adjacency::asymmetry may be. The ends of a wall are where its plane meets others, and move by the
/// planes' rounding over the sine of the angle between them. Of many random angles the least is about one
/// over their number; the angles of the wall concerned are looked at where more is wanted. However small they
/// are, no large wall may lack a side; where planes meet at right angles, one of a few tens of roundings may.
/// \param adjacency  with rows in order and from both sides
double allowed_asymmetry(const Adjacency& adjacency, const Domain& domain, const Rounding& rounding);

/// What is said where it is more.
std::string text_of_asymmetry(const Adjacency& adjacency);

}  // namespace powercell
