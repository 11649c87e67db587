#include "lib/applications/transport/state.hpp"

#include "lib/applications/transport/diagram_evaluator.hpp"
#include "lib/applications/transport/outcome.hpp"
#include "lib/applications/transport/periodic_domain.hpp"
#include "lib/base/positions.hpp"

namespace powercell {

TransportSolver::State::State(Device device, Domain domain, TransportOptions given)
    : options(std::move(given)),
      tolerance(options.tolerance),
      diagram(std::move(device), periodic_domain(std::move(domain), options.periodic), options.diagram) {
  if (diagram.domain().is_periodic() && !options.density.is_constant())
    throw Error(ErrorCode::unsupported, "in a periodic domain the density must be constant");
}

double TransportSolver::State::used_tolerance() const {
  if (tolerance > 0) return tolerance;
  return diagram.precision() == Precision::float32 ? 1e-3 : 1e-6;
}

const TransportResult& TransportSolver::State::solve() {
  if (positions.empty())
    throw Error(ErrorCode::invalid_argument, "solve before set_seeds: there are no seeds");
  if (diagram.has_selection()) diagram.select_all();

  TransportResult next;
  const std::size_t d = dimension();
  next.total_mass = domain_mass(options, diagram.domain());
  next.target = target_masses(masses, size(), next.total_mass, options.rescale, AllSeeds());
  next.merged_with = first_at_position(diagram.domain().wrapped(positions), d);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < size(); ++i)
    if (next.merged_with[i] == i) kept.push_back(i);
  next.merged = size() - kept.size();
  std::vector<double> joined(size());
  for (std::size_t i = 0; i < size(); ++i) joined[next.merged_with[i]] += next.target[i];

  const std::vector<double> kept_positions = rows(positions, kept, d), kept_weights = rows(weights, kept, 1);
  diagram_has_weights = false;
  if (next.merged > 0 || !diagram_has_all) {
    diagram_has_all = false;
    diagram.set_seeds({diagram.domain().dimension(), kept_positions, kept_weights});
    diagram_has_all = next.merged == 0;
  }
  next.tolerance = used_tolerance();
  const Vector kept_target = vector_of(rows(joined, kept, 1));
  DiagramEvaluator cells(diagram, kept_positions, {kept_target, next.tolerance}, options);
  const Iterate at =
      solve_and_report(cells, options, tolerance > 0, kept_target, vector_of(kept_weights), next);
  fill_arrays(at, kept, size(), d, next);
  for (std::size_t i = 0; i < size(); ++i) next.weights[i] = next.weights[next.merged_with[i]];
  result = std::move(next);
  weights = result.weights;
  diagram_has_weights = cells.last_weights() == at.weights;
  solved = true;
  return result;
}

}  // namespace powercell
