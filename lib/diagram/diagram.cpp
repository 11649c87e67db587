#include <algorithm>
#include <powercell/diagram.hpp>

#include "lib/base/threads.hpp"
#include "lib/collect/dual.hpp"
#include "lib/diagram/range.hpp"
#include "lib/diagram/state.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/seeds/given.hpp"
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
  const int threads = thread_count(s.options.threads);
  SeedSet ordered = make_seed_set(seeds, s.domain.dimension(), threads);
  require_in_range(seeds, s.scene.frame(), threads);
  GivenSeeds left_out = duplicates_of(ordered, seeds);
  s.forget_results();
  s.ready = s.ordered = s.paired = s.sifted = false;
  s.rest.reset();
  s.seeds = std::move(ordered);
  s.duplicate_positions = std::move(left_out.positions);
  s.duplicate_weights = std::move(left_out.weights);
  s.given = true;
  s.timings = {};
  s.timings.prepare = watch.seconds();
}

void Diagram::set_weights(std::span<const double> weights) {
  State& s = *state_;
  if (!s.given)
    throw Error(ErrorCode::invalid_argument, "set_weights before set_seeds: give the seeds first");
  Stopwatch watch;
  if (weights.size() != s.seeds.input_count)
    throw Error(ErrorCode::invalid_argument, std::to_string(weights.size()) + " weights for " +
                                                 std::to_string(s.seeds.input_count) + " seeds");
  if (!s.seeds.duplicate.empty()) {
    // Which of several seeds at one position stays depends on their weights.
    const GivenSeeds given = given_seeds(s.seeds, s.duplicate_positions, s.duplicate_weights);
    set_seeds(SeedsView{s.domain.dimension(), given.positions, weights});
    return;
  }
  const int threads = thread_count(s.options.threads);
  validate_weights(weights, threads);
  require_in_range(SeedsView{s.domain.dimension(), {}, weights}, s.scene.frame(), threads);
  s.forget_results();
  s.ready = s.sifted = false;
  parallel_for(threads_for(s.seeds.size(), threads), s.seeds.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t rank = begin; rank < end; ++rank) s.seeds.weights[rank] = weights[s.seeds.input[rank]];
  });
  s.timings = {};
  s.timings.prepare = watch.seconds();
}

std::size_t Diagram::size() const {
  return state_->seeds.input_count;
}
std::vector<double> Diagram::positions() const {
  return given_seeds(state_->seeds, state_->duplicate_positions, state_->duplicate_weights).positions;
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
  if (!s.dual) {
    const GivenSeeds given = given_seeds(s.seeds, s.duplicate_positions, s.duplicate_weights);
    s.dual = make_dual(cells(), SeedsView{s.domain.dimension(), given.positions, given.weights});
  }
  return *s.dual;
}

Measures measure(const Device& device, const Domain& domain, const SeedsView& seeds, const Options& options) {
  Diagram diagram(device, domain, options);
  diagram.set_seeds(seeds);
  return diagram.measures();
}

}  // namespace powercell
