#include "lib/diagram/range.hpp"

#include <cmath>
#include <powercell/error.hpp>
#include <string>

#include "lib/base/text.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

[[noreturn]] void refuse(std::size_t seed, const std::string& what, double value, bool float32) {
  throw Error(ErrorCode::invalid_seed,
              "seed " + std::to_string(seed) + ": " + what + " is " + digits(value) +
                  ", too large beside the domain for " + (float32 ? "single" : "double") +
                  " precision, in which its square would not be finite; remove this seed" +
                  (float32 ? " or use double precision" : ""));
}

}  // namespace

void require_in_range(const SeedsView& seeds, const Frame& frame, int threads) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  const auto bad_position = [&](std::size_t at) {
    return !(std::abs(frame.to_device(seeds.positions[at], static_cast<int>(at % d))) <=
             frame.most_coordinate());
  };
  const auto bad_weight = [&](std::size_t i) {
    return !(std::abs(frame.weight_to_device(seeds.weights[i])) <= frame.most_weight());
  };
  const std::size_t position = first_of(seeds.positions.size(), threads, bad_position);
  if (position < seeds.positions.size())
    refuse(position / d, std::string("coordinate ") + "xyz"[position % d], seeds.positions[position],
           frame.split);
  const std::size_t weight = first_of(seeds.weights.size(), threads, bad_weight);
  if (weight < seeds.weights.size()) refuse(weight, "weight", seeds.weights[weight], frame.split);
}

}  // namespace powercell
