/// \file
/// Seeds in NumPy arrays.
#pragma once

#include <powercell/seeds.hpp>

#include "python/src/arrays.hpp"

namespace powercell::python {

using Weights = std::optional<Vector<double>>;

/// Of the arrays, which must outlive it.
inline SeedsView seeds_of(const Matrix<double>& positions, const Weights& weights) {
  return {static_cast<int>(positions.shape(1)), span_of(positions),
          weights ? span_of(*weights) : std::span<const double>()};
}

}  // namespace powercell::python
