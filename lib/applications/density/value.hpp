/// \file
/// Values of densities, checked. Internal.
#pragma once

#include <powercell/density.hpp>
#include <powercell/error.hpp>
#include <span>
#include <string>

#include "lib/applications/density/piece.hpp"

namespace powercell {

inline bool is_density(double value) {
  return value >= 0 && value <= Density::largest_value;
}

/// \throw Error invalid_argument
[[noreturn]] void refuse_density(double value, const std::string& where);

/// Values given one by one: each must be a density, one positive.
/// \param name_of  what value k is, e.g. "pixel 3, 4"   \throw Error invalid_argument
template <class Name>
void check_densities(std::span<const double> values, const std::string& all, const Name& name_of) {
  bool any = false;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!is_density(values[k])) refuse_density(values[k], name_of(k));
    any |= values[k] > 0;
  }
  if (!any) throw Error(ErrorCode::invalid_argument, all + ": the density is 0 everywhere");
}

}  // namespace powercell
