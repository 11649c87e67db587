/// \file
/// Subdivision of a domain where a density varies, for random points.
#pragma once

#include <string>
#include <vector>

#include "lib/applications/density/model.hpp"

namespace powercell {

/// A triangle, or with `corners` 4 a tetrahedron.
struct Part {
  std::uint32_t region;  ///< of the domain
  std::size_t corners;
  std::array<Point, 4> corner;
  double measure = 0, longest = 0;  ///< longest: length of the longest edge
  double mass = 0;                  ///< integral of the density
  double most = 0;                  ///< largest density evaluated in it, at least the mean
  Point at_most{};                  ///< where that was
  /// measure x most - mass: expected rejections. Larger if the evaluated points represent the mass poorly.
  double waste = 0;
};

/// \throw Error invalid_argument, with what the caller may do
[[noreturn]] void refuse_too_small_a_part(const std::string& why);

/// Subdivides a domain until rejection sampling in the parts, which keeps a uniform point with the
/// probability density / most, keeps a good share of the points. For any density but a constant.
/// \throw Error invalid_argument if no part is found to have mass, or the density is too uneven
std::vector<Part> parts_by_density(const Domain& domain, const DensityModel& density);

}  // namespace powercell
