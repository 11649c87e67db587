/// \file
/// The tolerance for the difference between the two sides of a wall. Internal.
#pragma once

#include <string>

#include "lib/verify/rounding.hpp"

namespace powercell {

/// The largest allowed Adjacency::asymmetry. A wall ends where its plane meets others; there it moves by the
/// rounding of the planes over the sine of their angle. The least of many random angles is about one over
/// their number. If the asymmetry exceeds that, the angles of the wall concerned are computed. In no case may
/// half of the largest wall be missing, and differences of a few tens of roundings, as at right angles, are
/// always allowed.
/// \pre the rows are ascending and symmetric
double allowed_asymmetry(const Adjacency& adjacency, const Domain& domain, const Rounding& rounding);

/// Describes the asymmetry, for messages.
std::string text_of_asymmetry(const Adjacency& adjacency);

}  // namespace powercell
