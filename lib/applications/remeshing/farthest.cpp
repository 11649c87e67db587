#include "lib/applications/remeshing/farthest.hpp"

#include <algorithm>
#include <powercell/error.hpp>

namespace powercell::remeshing {
namespace {

/// As std::shuffle, but with the same result on every machine.
void shuffle(std::vector<std::uint32_t>& ids, std::mt19937_64& random) {
  for (std::size_t k = ids.size(); k > 1; --k) std::swap(ids[k - 1], ids[random() % k]);
}

}  // namespace

void fill_farthest(Sampling& sampling, std::size_t count, Progress progress) {
  constexpr std::size_t pieces_a_tick = 100;  // a cell with more counts as more work
  if (sampling.diagram().alive() == 0 && count > 0) {
    const Surface& surface = sampling.diagram().surface();
    sampling.add_free({0, surface.corner(0, 0)});
  }
  progress.at(0);
  while (sampling.diagram().alive() < count) {
    const FarPoint far = sampling.farthest();
    if (far.place.triangle == nothing)
      throw Error(ErrorCode::invalid_argument,
                  "too many points: there is no room between the points on the kept edges for more than " +
                      std::to_string(sampling.diagram().alive()));
    const std::uint32_t seed = sampling.add_free(far.place);
    // The first cells cover large parts of the surface.
    progress.tick(1 + sampling.diagram().pieces(seed).size() / pieces_a_tick);
  }
}

std::vector<double> optimise_farthest(Sampling& sampling, int rounds, Progress progress) {
  constexpr double gain = 1.001;  // factor by which the least spacing must grow
  constexpr int patience = 3;     // rounds without gain, as the least spacing fluctuates
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
      if (++done % 256 == 0)
        progress.at((round + static_cast<double>(done) / static_cast<double>(order.size())) / rounds);
    }
    progress.at((round + 1.0) / rounds);
    history.push_back(sampling.least_spacing());
    without_gain = history.back() > best * gain ? 0 : without_gain + 1;
    best = std::max(best, history.back());
  }
  return history;
}

}  // namespace powercell::remeshing
