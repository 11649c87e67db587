/// \file
/// Whether seeds are in the range in which the device can compute. Internal.
#pragma once

#include <powercell/seeds.hpp>

#include "lib/domain/frame.hpp"

namespace powercell {

/// Distances are squared: a position or weight may be finite and its square not. In units of the domain's
/// size coordinates reach to 1e140 and weights to 1e280, in single precision to 1e17 and 1e34 (as in
/// kernels/base/point.cl). Finite sizes are expected. \throw Error invalid_seed (which seed and value)
void require_in_range(const SeedsView& seeds, const Frame& frame, int threads);

}  // namespace powercell
