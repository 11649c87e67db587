/// \file
/// The lift of weighted seeds to unweighted points one dimension up (paper, section 3).
#pragma once

#include <vector>

#include "lib/domain/frame.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// h_i = sqrt(eta - w_i) by rank, in units of the frame; eta = NaN means the largest weight.
/// \throw Error invalid_argument if eta is below the largest weight, or beyond what a weight may be
std::vector<double> lift_heights(const SeedSet& seeds, double eta, const Frame& frame);

}  // namespace powercell
