#include <cmath>
#include <powercell/transport.hpp>

#include "lib/applications/transport/outcome.hpp"
#include "lib/applications/transport/state.hpp"
#include "lib/base/float_environment.hpp"

namespace powercell {
const char* name(TransportPhase phase) noexcept {
  switch (phase) {
    case TransportPhase::start:
      return "start";
    case TransportPhase::newton:
      return "newton";
    case TransportPhase::ramp:
      return "ramp";
    case TransportPhase::ascent:
      return "ascent";
  }
  return "unknown";
}

std::size_t TransportResult::newton_steps() const {
  std::size_t count = 0;
  for (const TransportStep& step : steps) count += step.phase != TransportPhase::start ? 1 : 0;
  return count;
}

TransportSolver::TransportSolver(Device device, Domain domain, TransportOptions options) {
  const FloatEnvironment environment;
  require_valid(options);
  state_ = std::make_unique<State>(std::move(device), std::move(domain), std::move(options));
}
TransportSolver::TransportSolver(TransportSolver&&) noexcept = default;
TransportSolver& TransportSolver::operator=(TransportSolver&&) noexcept = default;
TransportSolver::~TransportSolver() = default;

void TransportSolver::set_seeds(const SeedsView& seeds) {
  const FloatEnvironment environment;
  State& s = *state_;
  if (seeds.size() == 0) refuse("no seeds: a transport needs at least one");
  s.diagram.set_seeds(seeds);
  s.diagram_has_all = true;
  s.solved = false;
  s.positions.assign(seeds.positions.begin(), seeds.positions.end());
  s.weights.assign(seeds.weights.begin(), seeds.weights.end());
  s.weights.resize(s.size());
  if (s.masses.size() != s.size()) s.masses.clear();
}

void TransportSolver::move_seeds(std::span<const double> positions) {
  const FloatEnvironment environment;
  State& s = *state_;
  if (s.positions.empty()) refuse("move_seeds before set_seeds: give the seeds first");
  if (positions.size() != s.positions.size())
    refuse(std::to_string(positions.size()) + " coordinates for " + std::to_string(s.size()) + " seeds");
  std::vector<double> weights = s.weights;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const double by = positions[k] - s.positions[k];
    weights[k / s.dimension()] -= by * by;
  }
  s.diagram.set_seeds({s.diagram.domain().dimension(), positions, weights});
  s.diagram_has_all = true;
  s.solved = false;
  s.positions.assign(positions.begin(), positions.end());
  s.weights = std::move(weights);
}

void TransportSolver::set_weights(std::span<const double> weights) {
  const FloatEnvironment environment;
  State& s = *state_;
  if (weights.size() != s.size())
    refuse(std::to_string(weights.size()) + " weights for " + std::to_string(s.size()) + " seeds");
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (!std::isfinite(weights[i]))
      throw Error(ErrorCode::invalid_seed, "seed " + std::to_string(i) + ": the weight is not finite");
  s.weights.assign(weights.begin(), weights.end());
}

void TransportSolver::set_masses(std::span<const double> masses) {
  const FloatEnvironment environment;
  State& s = *state_;
  require_valid_masses(masses, s.size());
  s.masses.assign(masses.begin(), masses.end());
}

void TransportSolver::set_tolerance(double tolerance) {
  const FloatEnvironment environment;
  TransportOptions options;
  options.tolerance = tolerance;
  require_valid(options);
  state_->tolerance = tolerance > 0 ? tolerance : state_->options.tolerance;
}

void TransportSolver::set_max_steps(int steps) {
  TransportOptions options;
  options.max_steps = steps;
  require_valid(options);
  state_->options.max_steps = steps;
}

const TransportResult& TransportSolver::solve() {
  const FloatEnvironment environment;
  return state_->solve();
}

const TransportResult& TransportSolver::result() const {
  return state_->result;
}

Diagram& TransportSolver::diagram() {
  State& s = *state_;
  if (!s.solved) refuse("diagram before solve: there are no weights for these seeds yet");
  if (!s.diagram_has_all) {
    s.diagram.set_seeds({s.diagram.domain().dimension(), s.positions, s.result.weights});
    s.diagram_has_all = true;
  } else if (!s.diagram_has_weights) {
    s.diagram.set_weights(s.result.weights);
  }
  s.diagram_has_weights = true;
  return s.diagram;
}

TransportResult transport(const Device& device, const Domain& domain, const SeedsView& seeds,
                          std::span<const double> masses, const TransportOptions& options) {
  const FloatEnvironment environment;
  TransportSolver solver(device, domain, options);
  solver.set_seeds(seeds);
  solver.set_masses(masses);
  return solver.solve();
}

}  // namespace powercell
