#include "lib/applications/transport/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "lib/base/text.hpp"

namespace powercell {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Largest relative difference of the sum of the masses from the domain's mass, without rescaling.
constexpr double sum_tolerance = 1e-9;

}  // namespace

void refuse(const std::string& what) {
  throw Error(ErrorCode::invalid_argument, what);
}

void require_valid(const TransportOptions& options) {
  if (!(options.tolerance >= 0) || !(options.tolerance < 1))
    refuse("the tolerance must be in [0, 1), got " + std::to_string(options.tolerance));
  if (!(options.linear_residual > 0) || !(options.linear_residual < 1))
    refuse("the linear residual must be in (0, 1), got " + std::to_string(options.linear_residual));
  if (options.max_steps < 0) refuse("max_steps is negative");
}

void require_valid_masses(std::span<const double> masses, std::size_t seeds, std::uint64_t first) {
  if (!masses.empty() && masses.size() != seeds)
    refuse(std::to_string(masses.size()) + " masses for " + std::to_string(seeds) + " seeds");
  for (std::size_t i = 0; i < masses.size(); ++i)
    if (!(masses[i] > 0) || !std::isfinite(masses[i]))
      refuse("seed " + std::to_string(first + i) + ": the mass is " + std::to_string(masses[i]) +
             "; masses must be positive and finite");
}

double domain_mass(const TransportOptions& options, const Domain& domain) {
  const double total = options.density.total(domain, options.diagram.threads);
  if (!(total >= std::numeric_limits<double>::min()))
    refuse("the mass of the domain is " + digits(total) + ": choose another unit for the density");
  return total;
}

std::vector<double> target_masses(std::span<const double> masses, std::size_t seeds, double total,
                                  bool rescale, const AllSeeds& all, std::uint64_t first) {
  std::vector<double> result(masses.begin(), masses.end());
  const std::size_t count = all.count(seeds);
  if (!all.any(!masses.empty())) {
    result.assign(seeds, total / static_cast<double>(count));
  } else {
    // Relative to the largest mass, as the sum of masses may overflow.
    const double largest = all.greatest_of(vector_of(masses)), sum = all.sum_of(vector_of(masses) / largest);
    if (!rescale && !(std::abs(sum * largest - total) <= sum_tolerance * total))
      refuse("the masses sum to " + digits(sum * largest, 12) + ", the domain's mass is " +
             digits(total, 12) + "; to use their ratios, set the option rescale");
    for (double& m : result) m = m / largest * (total / sum);
  }
  for (std::size_t i = 0; i < seeds; ++i)
    if (!(result[i] >= std::numeric_limits<double>::min()))
      refuse("seed " + std::to_string(first + i) + ": its mass is " + digits(result[i]) +
             " of the domain's " + digits(total) + ", too small for a double");
  return result;
}

std::vector<double> rows(std::span<const double> values, const std::vector<std::uint32_t>& kept,
                         std::size_t width) {
  std::vector<double> result(kept.size() * width);
  for (std::size_t k = 0; k < kept.size(); ++k)
    std::copy_n(&values[kept[k] * width], width, &result[k * width]);
  return result;
}

Vector vector_of(std::span<const double> values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Iterate solve_and_report(Evaluator& evaluator, const TransportOptions& options, bool tolerance_given,
                         const Vector& target, const Vector& weights, TransportResult& result) {
  SolveContext context(evaluator, options, result.tolerance, tolerance_given, target);
  Iterate at = run_phases(context, weights);
  result.steps = context.steps();
  result.diagrams = evaluator.diagrams();
  result.error = at.error(target);
  result.quadrature_error = at.quadrature_error(target);
  result.rounding_error = at.rounding_error(target);
  result.converged = result.error < context.attainable(at, target, result.tolerance) &&
                     result.quadrature_error < result.tolerance;
  result.primal = at.primal();
  result.dual = at.dual(target);
  return at;
}

void fill_arrays(const Iterate& at, const std::vector<std::uint32_t>& kept, std::size_t n, std::size_t d,
                 TransportResult& result) {
  result.weights.assign(n, 0);
  result.mass.assign(n, 0);
  result.second_moment.assign(n, 0);
  result.centroid.assign(n * d, nan);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    result.weights[kept[k]] = at.weights[static_cast<Eigen::Index>(k)];
    result.mass[kept[k]] = at.cells.mass[k];
    result.second_moment[kept[k]] = at.cells.second_moment[k];
    std::copy_n(&at.cells.centroid[k * d], d, &result.centroid[kept[k] * d]);
  }
}

}  // namespace powercell
