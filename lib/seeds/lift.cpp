#include "lib/seeds/lift.hpp"

#include <algorithm>
#include <cmath>

#include <powercell/error.hpp>

namespace powercell {

std::vector<double> lift_heights(const SeedSet& seeds, double eta) {
  std::vector<double> heights(seeds.size());
  if (heights.empty()) return heights;
  const double largest = *std::max_element(seeds.weights.begin(), seeds.weights.end());
  if (std::isnan(eta)) eta = largest;
  if (!(eta >= largest))
    throw Error(ErrorCode::invalid_argument, "the height of the lift, " + std::to_string(eta) +
                                                 ", is below the largest weight, " + std::to_string(largest) +
                                                 "; leave it unset to use the largest weight");
  std::transform(seeds.weights.begin(), seeds.weights.end(), heights.begin(),
                 [eta](double w) { return std::sqrt(eta - w); });
  return heights;
}

}  // namespace powercell
