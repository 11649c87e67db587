/// \file
/// The lift of weighted seeds to unweighted points one dimension up (paper, section 3).
#pragma once

#include <vector>

#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// h_i = sqrt(eta - w_i) by rank; eta = NaN means the largest weight.
/// \throw Error invalid_argument if eta is below the largest weight
std::vector<double> lift_heights(const SeedSet& seeds, double eta);

}  // namespace powercell
