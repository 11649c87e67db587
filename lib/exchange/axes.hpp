/// \file
/// Sums along the axes of the plane or of space.
#pragma once

#include <cstddef>

namespace powercell::exchange {

/// The sum of term(k) for the axes k < d, which are 2 or 3. Without a loop, which costs more than short
/// terms.
template <class Term>
double sum_along(std::size_t d, const Term& term) {
  const double plane = term(0) + term(1);
  return d == 2 ? plane : plane + term(2);
}

}  // namespace powercell::exchange
