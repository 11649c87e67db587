#include "lib/seeds/lift.hpp"

#include <algorithm>
#include <cmath>
#include <powercell/error.hpp>
#include <string>

#include "lib/base/text.hpp"

namespace powercell {
namespace {

[[noreturn]] void refuse(double eta, const std::string& why) {
  throw Error(ErrorCode::invalid_argument, "the height of the lift, " + digits(eta) + ", is " + why +
                                               "; leave it unset to use the largest weight");
}

}  // namespace

std::vector<double> lift_heights(const SeedSet& seeds, double eta, const Frame& frame) {
  std::vector<double> heights(seeds.size());
  if (heights.empty()) return heights;
  const double largest = *std::max_element(seeds.weights.begin(), seeds.weights.end());
  if (std::isnan(eta)) eta = largest;
  if (!(eta >= largest)) refuse(eta, "below the largest weight, " + digits(largest));
  const double top = frame.weight_to_device(eta);
  // Beyond, distances between lifted seeds are infinite, and lists of the nearest are of any.
  if (!(top <= frame.most_weight()))
    refuse(eta, "too large beside the domain, where its square would not be finite");
  std::transform(seeds.weights.begin(), seeds.weights.end(), heights.begin(),
                 [&](double w) { return std::sqrt(top - frame.weight_to_device(w)); });
  return heights;
}

}  // namespace powercell
