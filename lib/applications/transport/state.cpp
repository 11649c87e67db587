#include "lib/applications/transport/state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/applications/transport/periodic_domain.hpp"
#include "lib/applications/transport/phases.hpp"
#include "lib/base/positions.hpp"
#include "lib/base/text.hpp"

namespace powercell {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Largest relative difference of the sum of the masses from the domain's mass, without rescaling.
constexpr double sum_tolerance = 1e-9;

/// The rows with the indices `kept`, each of `width` values.
std::vector<double> rows(std::span<const double> values, const std::vector<std::uint32_t>& kept,
                         std::size_t width) {
  std::vector<double> result(kept.size() * width);
  for (std::size_t k = 0; k < kept.size(); ++k)
    std::copy_n(&values[kept[k] * width], width, &result[k * width]);
  return result;
}

Vector vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

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

std::vector<double> TransportSolver::State::targets(double total) const {
  std::vector<double> result = masses;
  if (masses.empty()) {
    result.assign(size(), total / static_cast<double>(size()));
  } else {
    // Relative to the largest mass, as the sum of masses may overflow.
    const double largest = vector_of(masses).maxCoeff(), sum = (vector_of(masses) / largest).sum();
    if (!options.rescale && !(std::abs(sum * largest - total) <= sum_tolerance * total))
      throw Error(ErrorCode::invalid_argument, "the masses sum to " + digits(sum * largest, 12) +
                                                   ", the domain's mass is " + digits(total, 12) +
                                                   "; to use their ratios, set the option rescale");
    for (double& m : result) m = m / largest * (total / sum);
  }
  for (std::size_t i = 0; i < size(); ++i)
    if (!(result[i] >= std::numeric_limits<double>::min()))
      throw Error(ErrorCode::invalid_argument, "seed " + std::to_string(i) + ": its mass is " +
                                                   digits(result[i]) + " of the domain's " + digits(total) +
                                                   ", too small for a double");
  return result;
}

const TransportResult& TransportSolver::State::solve() {
  if (positions.empty())
    throw Error(ErrorCode::invalid_argument, "solve before set_seeds: there are no seeds");
  if (diagram.has_selection()) diagram.select_all();
  const double total = options.density.total(diagram.domain(), options.diagram.threads);
  if (!(total >= std::numeric_limits<double>::min()))
    throw Error(ErrorCode::invalid_argument,
                "the mass of the domain is " + digits(total) + ": choose another unit for the density");
  const std::vector<double> target = targets(total);

  TransportResult next;
  const std::size_t d = dimension();
  next.merged_with = first_at_position(diagram.domain().wrapped(positions), d);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < size(); ++i)
    if (next.merged_with[i] == i) kept.push_back(i);
  next.merged = size() - kept.size();
  std::vector<double> joined(size());
  for (std::size_t i = 0; i < size(); ++i) joined[next.merged_with[i]] += target[i];

  const std::vector<double> kept_positions = rows(positions, kept, d), kept_weights = rows(weights, kept, 1);
  diagram_has_weights = false;
  if (next.merged > 0 || !diagram_has_all) {
    diagram_has_all = false;
    diagram.set_seeds({diagram.domain().dimension(), kept_positions, kept_weights});
    diagram_has_all = next.merged == 0;
  }
  next.total_mass = total;
  next.tolerance = used_tolerance();
  next.target = target;
  const Vector kept_target = vector_of(rows(joined, kept, 1));
  Evaluator cells(diagram, options.density, kept_positions, {kept_target, used_tolerance()},
                  options.diagram.threads);
  SolveContext context(cells, options, next.tolerance, tolerance > 0, kept_target);
  const Iterate at = run_phases(context, vector_of(kept_weights));
  next.steps = context.steps();
  next.diagrams = cells.diagrams();
  next.error = at.error(kept_target);
  next.quadrature_error = at.quadrature_error(kept_target);
  next.rounding_error = at.rounding_error(kept_target);
  next.converged = next.error < context.attainable(at, kept_target, next.tolerance) &&
                   next.quadrature_error < next.tolerance;
  next.primal = at.primal();
  next.dual = at.dual(kept_target);
  result = std::move(next);
  fill_result(at, kept);
  diagram_has_weights = cells.last_weights() == at.weights;
  solved = true;
  return result;
}

void TransportSolver::State::fill_result(const Iterate& at, const std::vector<std::uint32_t>& kept) {
  const std::size_t n = size(), d = dimension();
  result.mass.assign(n, 0);
  result.second_moment.assign(n, 0);
  result.centroid.assign(n * d, nan);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    weights[kept[k]] = at.weights[static_cast<Eigen::Index>(k)];
    result.mass[kept[k]] = at.cells.mass[k];
    result.second_moment[kept[k]] = at.cells.second_moment[k];
    std::copy_n(&at.cells.centroid[k * d], d, &result.centroid[kept[k] * d]);
  }
  for (std::size_t i = 0; i < n; ++i) weights[i] = weights[result.merged_with[i]];
  result.weights = weights;
}

}  // namespace powercell
