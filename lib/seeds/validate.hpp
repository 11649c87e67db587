/// \file
/// Refuses seeds that no diagram can be made of. Internal.
#pragma once

#include <powercell/seeds.hpp>

namespace powercell {

/// \throw Error invalid_argument (dimension and sizes), invalid_seed (the first seed with a NaN or an
/// infinity)
void validate_seeds(const SeedsView& seeds, int dimension, int threads);
/// Weights alone. \throw Error invalid_seed
void validate_weights(std::span<const double> weights, int threads);

}  // namespace powercell
