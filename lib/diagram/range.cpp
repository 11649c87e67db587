#include "lib/diagram/range.hpp"

#include <cmath>
#include <powercell/error.hpp>
#include <sstream>

namespace powercell {
namespace {

[[noreturn]] void refuse(std::size_t seed, const std::string& what, double value, bool float32) {
  std::ostringstream text;
  text << "seed " << seed << ": " << what << " is " << value << ", too large beside the domain for "
       << (float32 ? "single" : "double")
       << " precision, in which its square would not be finite; remove this seed"
       << (float32 ? " or use double precision" : "");
  throw Error(ErrorCode::invalid_seed, text.str());
}

}  // namespace

void require_in_range(const SeedsView& seeds, const Frame& frame) {
  const double most_coordinate = frame.split ? 1e17 : 1e140, most_weight = frame.split ? 1e34 : 1e280;
  const auto d = static_cast<std::size_t>(seeds.dimension);
  for (std::size_t at = 0; at < seeds.positions.size(); ++at)
    if (!(std::abs(frame.to_device(seeds.positions[at], static_cast<int>(at % d))) <= most_coordinate))
      refuse(at / d, std::string("coordinate ") + "xyz"[at % d], seeds.positions[at], frame.split);
  for (std::size_t i = 0; i < seeds.weights.size(); ++i)
    if (!(std::abs(frame.weight_to_device(seeds.weights[i])) <= most_weight))
      refuse(i, "weight", seeds.weights[i], frame.split);
}

}  // namespace powercell
