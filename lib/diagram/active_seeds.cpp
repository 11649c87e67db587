#include "lib/diagram/active_seeds.hpp"

#include <algorithm>
#include <cmath>

#include "lib/neighbors/hidden_seeds.hpp"
#include "lib/report/log.hpp"

namespace powercell {
namespace {

/// So low that the cell is empty everywhere: the power distance exceeds all others by several squares of the
/// common extent of domain and seeds. A power of two keeps exact integers short.
double excluding_weight(const Domain& domain, const SeedSet& seeds) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  double diagonal2 = 0, largest = 0;
  for (std::size_t k = 0; k < d; ++k) {
    double low = domain.low()[k], high = domain.high()[k];
    for (std::size_t at = k; at < seeds.positions.size(); at += d) {
      low = std::min(low, seeds.positions[at]);
      high = std::max(high, seeds.positions[at]);
    }
    diagonal2 += (high - low) * (high - low);
  }
  for (const double w : seeds.weights) largest = std::max(largest, std::abs(w));
  return -std::ldexp(1.0, std::ilogb(std::max(diagonal2, largest)) + 4);
}

}  // namespace

ActiveSeeds::ActiveSeeds(const DiagramSetup& setup, const GivenSeeds& input, SeedBuffers& buffers,
                         std::optional<KeptTree> kept)
    : setup_(setup), input_(input), buffers_(buffers) {
  if (const Period* const period = setup.period()) {
    const double margin = first_margin(*period, input.seeds);
    if (kept && kept->images && kept->images->own == input.seeds.size() && kept->images->margin == margin &&
        kept->images->seed_margin.empty()) {
      images_ = std::move(kept->images);
      set_weights(*images_, input.seeds, setup.threads);
    } else {
      images_ = make_images(*period, input.seeds, margin, setup.threads);
      kept.reset();
    }
  }
  if (kept && kept->tree.seeds == seeds().size()) {
    tree_ = std::move(kept->tree);
    refit_weights(tree_, seeds(), setup.threads);
    buffers_.upload_weights(setup.on_device.frame(), seeds(), tree_, setup.threads);
    if (setup.neighbors == Neighbors::tree) set_hidden_aside();
  } else {
    build();
  }
}

void ActiveSeeds::build() {
  tree_ = build_packed_tree(seeds(), setup_.threads);
  buffers_.upload(setup_.on_device.frame(), seeds(), tree_, setup_.threads);
  // The lists of FLANN are the paper's method and an oracle for the tree, so they use all seeds.
  if (setup_.neighbors == Neighbors::tree) set_hidden_aside();
}

void ActiveSeeds::set_hidden_aside() {
  const std::vector<std::uint8_t> hidden = hidden_seeds_if_many(scene());
  if (hidden.empty()) return;
  const std::size_t total = seeds().size();
  if (images_)
    images_ = without_hidden(*images_, hidden);
  else
    own_ = without_hidden(input_.seeds, hidden, setup_.threads);
  tree_ = build_packed_tree(seeds(), setup_.threads);
  buffers_.upload(setup_.on_device.frame(), seeds(), tree_, setup_.threads);
  write_log(LogLevel::info, [&] {
    return std::to_string(total - seeds().size()) + " of " + std::to_string(total) +
           " seeds are hidden by their neighbours and set aside";
  });
}

bool ActiveSeeds::widen(double margin, std::span<const double> clearance) {
  const std::size_t before = images_->seeds.size();
  powercell::widen(*images_, *setup_.period(), margin, clearance, setup_.threads);
  if (images_->seeds.size() == before) return false;
  tree_ = build_packed_tree(seeds(), setup_.threads);
  buffers_.upload(setup_.on_device.frame(), seeds(), tree_, setup_.threads);
  return true;
}

void ActiveSeeds::exclude_flat_cells(std::span<const std::uint32_t> ranks) {
  const double weight = excluding_weight(setup_.domain, input_.seeds);
  if (images_) {
    SeedSet& all = images_->seeds;
    for (std::uint32_t r = 0; r < all.size(); ++r)
      if (std::binary_search(ranks.begin(), ranks.end(), images_->seed_of(r))) all.weights[r] = weight;
  } else {
    if (!own_) own_ = input_.seeds;
    for (const std::uint32_t rank : ranks) own_->weights[rank] = weight;
  }
  refit_weights(tree_, seeds(), setup_.threads);
  buffers_.upload_weights(setup_.on_device.frame(), seeds(), tree_, setup_.threads);
  by_region.clear();
  write_log(LogLevel::info,
            [&] { return std::to_string(ranks.size()) + " seeds with flat cells excluded; recomputing"; });
}

}  // namespace powercell
