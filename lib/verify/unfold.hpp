/// \file
/// A periodic diagram as one without periods: images of seeds as seeds of their own.
#pragma once

#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <span>
#include <vector>

#include "lib/domain/period.hpp"

namespace powercell {

/// The results near the wrapped seeds, with which they were computed.
struct Unfolded {
  Measures measures;
  Cells cells;  ///< borders name the images, and have no shifts
  int dimension = 0;
  std::vector<double> positions;  ///< of the wrapped seeds, then of the images that borders name
  std::vector<double> weights;
  SeedsView seeds() const { return {dimension, positions, weights}; }
};

/// \param seeds    as given
/// \param wrapped  their positions in the domain
Unfolded unfold(const Measures& measures, const Cells& cells, const SeedsView& seeds,
                std::span<const double> wrapped, const Period& period);

}  // namespace powercell
