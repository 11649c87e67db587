/// \file
/// Lattice translations to neighbouring periods.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/domain/period.hpp"
#include "lib/exchange/boxes.hpp"
#include "lib/exchange/cut_test.hpp"

namespace powercell::exchange {

/// Lattice translations to the periods whose images may matter to a wrapped seed's cell; the first is zero.
/// Zero alone without periods.
/// \param period  null if the domain is not periodic
std::vector<Point> translations(const Period* period);

/// A row of position and weight, or a box, moved. Wrapped seeds are moved without rounding.
inline std::array<double, 4> moved(const double* row, const Point& by, std::size_t d) {
  std::array<double, 4> to{};
  for (std::size_t k = 0; k < d; ++k) to[k] = row[k] + by[k];
  to[d] = row[d];
  return to;
}
inline Box moved(const BoxView& box, const Point& by, std::size_t d) {
  Box to;
  for (std::size_t k = 0; k < d; ++k) {
    to.low[k] = box.low[k] + by[k];
    to.high[k] = box.high[k] + by[k];
  }
  return to;
}

}  // namespace powercell::exchange
