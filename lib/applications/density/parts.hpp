/// \file
/// A domain divided where a density varies, for random points. Internal.
#pragma once

#include <string>
#include <vector>

#include "lib/applications/density/model.hpp"

namespace powercell {

/// A triangle, or with `corners` 4 a tetrahedron.
struct Part {
  std::uint32_t region;  // of the domain
  std::size_t corners;
  std::array<Point, 4> corner;
  double measure = 0, longest = 0;  // and its longest edge
  double mass = 0;                  // integral of the density
  double most = 0;                  // the largest density seen in it, or the mean one where that is larger
  Point at_most{};                  // where that was seen
  double waste = 0;  // measure times most, less the mass; more where the points seen tell too little
};

/// \throw Error invalid_argument, with what the caller may do
[[noreturn]] void refuse_too_small_a_part(const std::string& why);

/// Divides a domain until uniform points of the parts, each kept with the probability density / most, are few
/// more than those kept. For every density but a constant. \throw Error invalid_argument if no part is found
/// to have mass, or the density is too uneven for that
std::vector<Part> parts_by_density(const Domain& domain, const DensityModel& density);

}  // namespace powercell
