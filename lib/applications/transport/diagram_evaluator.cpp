#include "lib/applications/transport/diagram_evaluator.hpp"

#include <algorithm>

namespace powercell {
namespace {

// Bounds of the error of integrals relative to the error of the masses. Near the solution the dual is off by
// about the square of the latter; for the first steps the larger share is accurate enough.
constexpr double least_share = 1e-4, most_share = 3e-3;
// Integrals are repeated if their tolerance was this many times what turns out to be needed.
constexpr double repeat_factor = 4;

double largest_relative_error(const Eigen::Map<const Vector>& mass, const Vector& target) {
  return (mass.array() / target.array() - 1).abs().maxCoeff();
}

/// a = (1 - share) a + share b, entry by entry.
void blend(std::vector<double>& a, const std::vector<double>& b, double share) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = (1 - share) * a[k] + share * b[k];
}

/// Blends the walls of a density with those of a uniform one, which include them.
Adjacency blend(const Adjacency& a, Adjacency uniform, double share) {
  for (std::size_t i = 0; i + 1 < uniform.offset.size(); ++i) {
    const auto begin = a.neighbor.begin() + static_cast<std::ptrdiff_t>(a.offset[i]);
    const auto end = a.neighbor.begin() + static_cast<std::ptrdiff_t>(a.offset[i + 1]);
    for (std::uint64_t k = uniform.offset[i]; k < uniform.offset[i + 1]; ++k) {
      const auto found = std::lower_bound(begin, end, uniform.neighbor[k]);
      const bool both = found != end && *found == uniform.neighbor[k];
      uniform.wall[k] *= share;
      if (both) uniform.wall[k] += (1 - share) * a.wall[static_cast<std::size_t>(found - a.neighbor.begin())];
    }
  }
  return uniform;
}

/// Integrals of (31c). Leaves the centroids unblended, as nothing uses them.
void blend(DensityIntegrals& integrals, DensityIntegrals uniform, double share) {
  blend(integrals.mass, uniform.mass, share);
  blend(integrals.second_moment, uniform.second_moment, share);
  integrals.walls = blend(integrals.walls, std::move(uniform.walls), share);
}

const AllSeeds all_here;

}  // namespace

DiagramEvaluator::DiagramEvaluator(Diagram& diagram, std::span<const double> positions, const Goal& goal,
                                   const TransportOptions& options)
    : Evaluator(diagram.domain(), positions, all_here), diagram_(diagram), options_(options), goal_(goal) {}

bool DiagramEvaluator::connects_all(const Laplacian& system) {
  return connected_components(system.matrix) == 1;
}

LinearResult DiagramEvaluator::solve(const Laplacian& system, const Vector& right) {
  return solve_laplacian(system, right, options_.linear, options_.linear_residual, domain().cell_dimension());
}

void DiagramEvaluator::set_spread(double share) {
  spread_ = share;
  if (share > 0 && !uniform_) {
    const Domain& domain = diagram_.domain();
    // Rounding may raise the mean of values that all are the largest above it.
    uniform_ = Density::constant(std::min(
        options_.density.total(domain, options_.diagram.threads) / domain.measure(), Density::largest_value));
  }
}

/// The tolerance of integrals if the masses are off by `error`.
double DiagramEvaluator::integral_tolerance(double error) const {
  if (precise_) return least_share * goal_.tolerance;
  const double off = std::max(goal_.tolerance, std::min(1.0, error));
  return off * std::max(least_share, most_share * off);
}

/// Integrates to the tolerance for the expected error of the masses, and again if the error turns out to be
/// much smaller. Formulas with kinks cost ten times as much for two more digits.
DensityIntegrals DiagramEvaluator::integrate_density() {
  IntegrationOptions options;
  options.walls = true;
  options.threads = options_.diagram.threads;
  options.tolerance = integral_tolerance(options_.density.is_exact() ? 0 : expected_error_);
  while (true) {
    double error = 0;
    bool enough = true;
    options.walls_if = [&](std::span<const double> mass) {
      error = largest_relative_error({mass.data(), goal_.target.size()}, goal_.target);
      const bool met = error < goal_.tolerance;
      enough = options.tolerance <= (met ? 1 : repeat_factor) * integral_tolerance(error);
      return enough && !met;
    };
    DensityIntegrals found = integrate(diagram_, options_.density, options);
    expected_error_ = error * error;  // Newton's method converges quadratically
    if (enough) return found;
    options.tolerance = integral_tolerance(error);
  }
}

DensityIntegrals DiagramEvaluator::integrate_blend() {
  IntegrationOptions options;
  options.walls = true;
  options.threads = options_.diagram.threads;
  options.tolerance = most_share;
  DensityIntegrals uniform = integrate(diagram_, *uniform_, options);
  if (spread_ == 1) return uniform;
  DensityIntegrals result = integrate(diagram_, options_.density, options);
  blend(result, std::move(uniform), spread_);
  return result;
}

void DiagramEvaluator::measure(Iterate& at) {
  last_weights_ = at.weights;
  diagram_.set_weights({at.weights.data(), static_cast<std::size_t>(at.weights.size())});
  if (diagram_.domain().kind() == DomainKind::surface) diagram_.compute(true, true);
  at.cells = spread_ > 0 ? integrate_blend() : integrate_density();
  if (at.cells.walls.offset.empty()) return;
  if (diagram_.domain().is_periodic())
    join_images(diagram_.domain(), positions(), at);
  else
    at.conductance = conductances(diagram_, at.cells.walls, positions());
}

}  // namespace powercell
