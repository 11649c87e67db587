#include "lib/remeshing/farthest.hpp"

#include <algorithm>
#include <powercell/error.hpp>

#include "lib/remeshing/interrupt.hpp"

namespace powercell::remeshing {
namespace {

constexpr std::size_t steps_between_calls = 256;  // added or moved seeds

/// A shuffle that is the same on every machine.
void shuffle(std::vector<std::uint32_t>& ids, std::mt19937_64& random) {
  for (std::size_t k = ids.size(); k > 1; --k) std::swap(ids[k - 1], ids[random() % k]);
}

}  // namespace

void fill_farthest(Sampling& sampling, std::size_t count, const std::function<bool(double)>& progress) {
  if (sampling.diagram().alive() == 0 && count > 0) {
    const Surface& surface = sampling.diagram().surface();
    sampling.add_free({0, surface.corner(0, 0)});
  }
  for (std::size_t added = 0; sampling.diagram().alive() < count; ++added) {
    if (added % steps_between_calls == 0) tell(progress, 0);
    const FarPoint far = sampling.farthest();
    if (far.place.triangle == nothing)
      throw Error(ErrorCode::invalid_argument,
                  "too many points: there is no room between the seeds of the kept edges for more than " +
                      std::to_string(sampling.diagram().alive()));
    sampling.add_free(far.place);
  }
}

std::vector<double> optimise_farthest(Sampling& sampling, int rounds,
                                      const std::function<bool(double)>& progress) {
  constexpr double at_rest = 1.001;
  constexpr int patience = 3;  // rounds without gain: the least of many spacings goes up and down
  std::vector<double> history;
  double best = 0;
  int without_gain = 0;
  for (int round = 0; round < rounds && without_gain < patience; ++round) {
    std::vector<std::uint32_t> order = sampling.free_seeds();
    shuffle(order, sampling.random());
    std::size_t done = 0;
    for (const std::uint32_t seed : order) {
      const Place old = sampling.hold(seed).place;
      sampling.remove(seed);
      const FarPoint far = sampling.farthest();
      sampling.add_free(far.place.triangle == nothing ? old : far.place);
      if (++done % steps_between_calls == 0)
        tell(progress, (round + static_cast<double>(done) / static_cast<double>(order.size())) / rounds);
    }
    tell(progress, (round + 1.0) / rounds);
    history.push_back(sampling.least_spacing());
    without_gain = history.back() > best * at_rest ? 0 : without_gain + 1;
    best = std::max(best, history.back());
  }
  return history;
}

}  // namespace powercell::remeshing
