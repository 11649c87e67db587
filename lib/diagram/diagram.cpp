#include <algorithm>
#include <powercell/diagram.hpp>

#include "lib/collect/dual.hpp"
#include "lib/diagram/range.hpp"
#include "lib/diagram/state.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/seeds/validate.hpp"

namespace powercell {

Diagram::Diagram(Device device, Domain domain, Options options)
    : state_(std::make_unique<State>(std::move(device), std::move(domain), std::move(options))) {}
Diagram::Diagram(Diagram&&) noexcept = default;
Diagram& Diagram::operator=(Diagram&&) noexcept = default;
Diagram::~Diagram() = default;

void Diagram::set_seeds(const SeedsView& seeds) {
  State& s = *state_;
  Stopwatch watch;
  SeedSet ordered = make_seed_set(seeds, s.domain.dimension(), thread_count(s.options.threads));
  require_in_range(seeds, s.scene.frame());
  s.forget_results();
  s.ready = s.ordered = false;
  s.seeds = std::move(ordered);
  s.input_positions.assign(seeds.positions.begin(), seeds.positions.end());
  s.input_weights.assign(seeds.weights.begin(), seeds.weights.end());
  s.input_weights.resize(seeds.size(), 0.0);
  s.given = true;
  s.timings = {};
  s.timings.prepare = watch.seconds();
}

void Diagram::set_weights(std::span<const double> weights) {
  State& s = *state_;
  if (!s.given)
    throw Error(ErrorCode::invalid_argument, "set_weights before set_seeds: give the seeds first");
  Stopwatch watch;
  const SeedsView seeds{s.domain.dimension(), s.input_positions, weights};
  if (weights.size() != s.input_weights.size() || !s.seeds.duplicate.empty()) {
    // Which of several seeds at one position stays depends on their weights; wrong sizes are refused there.
    if (weights.size() != s.input_weights.size())
      throw Error(ErrorCode::invalid_argument, std::to_string(weights.size()) + " weights for " +
                                                   std::to_string(s.input_weights.size()) + " seeds");
    set_seeds(SeedsView{seeds.dimension, std::vector<double>(s.input_positions), weights});
    return;
  }
  validate_seeds(seeds, seeds.dimension, thread_count(s.options.threads));
  require_in_range(seeds, s.scene.frame());
  s.forget_results();
  s.ready = false;
  s.input_weights.assign(weights.begin(), weights.end());
  for (std::size_t rank = 0; rank < s.seeds.size(); ++rank)
    s.seeds.weights[rank] = weights[s.seeds.input[rank]];
  s.timings = {};
  s.timings.prepare = watch.seconds();
}

std::size_t Diagram::size() const {
  return state_->seeds.input_count;
}
const Domain& Diagram::domain() const {
  return state_->domain;
}
const Device& Diagram::device() const {
  return state_->device;
}
Precision Diagram::precision() const {
  return state_->precision;
}
Neighbors Diagram::neighbors() const {
  return state_->neighbors;
}
const Timings& Diagram::timings() const {
  return state_->timings;
}

void Diagram::compute(bool adjacency, bool cells) {
  State& s = *state_;
  const bool need_adjacency = adjacency && !s.adjacency, need_cells = cells && !s.cells;
  if (!s.measures || need_adjacency || need_cells) s.run(need_adjacency, need_cells);
}

const Measures& Diagram::measures() {
  compute(false, false);
  return *state_->measures;
}

const Adjacency& Diagram::adjacency() {
  compute(true, false);
  return *state_->adjacency;
}

const Cells& Diagram::cells() {
  compute(false, true);
  return *state_->cells;
}

const Dual& Diagram::dual() {
  State& s = *state_;
  if (!s.dual)
    s.dual = make_dual(cells(), SeedsView{s.domain.dimension(), s.input_positions, s.input_weights});
  return *s.dual;
}

Measures measure(const Device& device, const Domain& domain, const SeedsView& seeds, const Options& options) {
  Diagram diagram(device, domain, options);
  diagram.set_seeds(seeds);
  return diagram.measures();
}

}  // namespace powercell
