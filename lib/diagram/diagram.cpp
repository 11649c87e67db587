#include <powercell/diagram.hpp>

#include "lib/base/float_environment.hpp"
#include "lib/diagram/state.hpp"

namespace powercell {

Diagram::Diagram(Device device, Domain domain, Options options) {
  const FloatEnvironment environment;
  state_ = std::make_unique<State>(std::move(device), std::move(domain), std::move(options));
}
Diagram::Diagram(Diagram&&) noexcept = default;
Diagram& Diagram::operator=(Diagram&&) noexcept = default;
Diagram::~Diagram() = default;

void Diagram::set_seeds(const SeedsView& seeds) {
  const FloatEnvironment environment;
  state_->set_seeds(seeds);
}
void Diagram::set_weights(std::span<const double> weights) {
  const FloatEnvironment environment;
  state_->set_weights(weights);
}
void Diagram::select(std::span<const std::uint32_t> seeds) {
  const FloatEnvironment environment;
  state_->select(seeds);
}
void Diagram::select_all() {
  const FloatEnvironment environment;
  state_->select_all();
}
bool Diagram::has_selection() const {
  return state_->selection.has_value();
}
void Diagram::compute(bool adjacency, bool cells) {
  const FloatEnvironment environment;
  state_->compute({.adjacency = adjacency, .cells = cells});
}

std::size_t Diagram::size() const {
  return state_->input ? state_->input->seeds.input_count : 0;
}
std::vector<double> Diagram::positions() const {
  const FloatEnvironment environment;
  return state_->input ? state_->input->given().positions : std::vector<double>();
}
const Domain& Diagram::domain() const {
  return state_->setup.domain;
}
const Device& Diagram::device() const {
  return state_->setup.device;
}
Precision Diagram::precision() const {
  return state_->setup.precision;
}
Neighbors Diagram::neighbors() const {
  return state_->setup.neighbors;
}
const Timings& Diagram::timings() const {
  return state_->timings;
}

const Measures& Diagram::measures() {
  const FloatEnvironment environment;
  compute(false, false);
  return *state_->results->measures;
}
const Adjacency& Diagram::adjacency() {
  const FloatEnvironment environment;
  compute(true, false);
  return *state_->results->adjacency;
}
const Cells& Diagram::cells() {
  const FloatEnvironment environment;
  return state_->cells();
}
const JoinedCells& Diagram::joined() {
  const FloatEnvironment environment;
  return state_->joined();
}
const BoundaryWalls& Diagram::boundary_walls() {
  const FloatEnvironment environment;
  return state_->boundary_walls();
}
const Dual& Diagram::dual() {
  const FloatEnvironment environment;
  return state_->dual();
}

std::shared_ptr<const void> Diagram::hold_results() const {
  return state_->results;
}

Measures measure(const Device& device, const Domain& domain, const SeedsView& seeds, const Options& options) {
  const FloatEnvironment environment;
  Diagram diagram(device, domain, options);
  diagram.set_seeds(seeds);
  return diagram.measures();
}

}  // namespace powercell
