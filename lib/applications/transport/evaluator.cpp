#include "lib/applications/transport/evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/base/work_clock.hpp"

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

}  // namespace

double Iterate::error(const Vector& target) const {
  return largest_relative_error(mass(), target);
}

double Iterate::quadrature_error(const Vector& target) const {
  if (cells.mass_error.empty()) return 0;
  return (Eigen::Map<const Vector>(cells.mass_error.data(), target.size()).array() / target.array())
      .maxCoeff();
}

Vector Iterate::rounding() const {
  const Adjacency& walls = cells.walls;
  Vector sum = Vector::Zero(weights.size());
  if (conductance.empty()) return sum;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (std::uint64_t k = walls.offset[row]; k < walls.offset[row + 1]; ++k)
      sum[i] += conductance[k] * (std::abs(weights[i]) + std::abs(weights[walls.neighbor[k]]));
  }
  return std::numeric_limits<double>::epsilon() * sum;
}

double Iterate::least(const Vector& target) const {
  return (mass().array() / target.array()).minCoeff();
}

Laplacian Iterate::laplacian(std::span<const double> shift) const {
  return make_laplacian(cells.walls.offset, cells.walls.neighbor, conductance, shift);
}

double Iterate::primal() const {
  return Eigen::Map<const Vector>(cells.second_moment.data(), weights.size()).sum();
}

double Iterate::dual(const Vector& target) const {
  return primal() + weights.dot(gradient(target));
}

Evaluator::Evaluator(Diagram& diagram, const Density& density, std::span<const double> positions,
                     const Goal& goal, int threads)
    : diagram_(diagram),
      density_(density),
      positions_(positions),
      dimension_(static_cast<std::size_t>(diagram.domain().dimension())),
      goal_(goal),
      threads_(threads) {}

bool Evaluator::plausible(const Vector& weights, const Vector& before) const {
  const auto range = [](const Vector& w) { return w.maxCoeff() - w.minCoeff(); };
  const Domain& domain = diagram_.domain();
  double square = 0;
  for (std::size_t c = 0; c < dimension_; ++c) {
    double low = domain.low()[c], high = domain.high()[c];
    for (std::size_t k = c; k < positions_.size(); k += dimension_) {
      low = std::min(low, positions_[k]);
      high = std::max(high, positions_[k]);
    }
    square += (high - low) * (high - low);
  }
  return range(weights) <= 4 * std::max(square, range(before));
}

void Evaluator::set_spread(double share) {
  spread_ = share;
  if (share > 0 && !uniform_) {
    const Domain& domain = diagram_.domain();
    // Rounding may raise the mean of values that all are the largest above it.
    uniform_ = Density::constant(
        std::min(density_.total(domain, threads_) / domain.measure(), Density::largest_value));
  }
}

/// The tolerance of integrals if the masses are off by `error`.
double Evaluator::integral_tolerance(double error) const {
  if (precise_) return least_share * goal_.tolerance;
  const double off = std::max(goal_.tolerance, std::min(1.0, error));
  return off * std::max(least_share, most_share * off);
}

/// Integrates to the tolerance for the expected error of the masses, and again if the error turns out to be
/// much smaller. Formulas with kinks cost ten times as much for two more digits.
DensityIntegrals Evaluator::integrate_density() {
  IntegrationOptions options;
  options.walls = true;
  options.threads = threads_;
  options.tolerance = integral_tolerance(density_.is_exact() ? 0 : expected_error_);
  while (true) {
    double error = 0;
    bool enough = true;
    options.walls_if = [&](std::span<const double> mass) {
      error = largest_relative_error({mass.data(), goal_.target.size()}, goal_.target);
      const bool met = error < goal_.tolerance;
      enough = options.tolerance <= (met ? 1 : repeat_factor) * integral_tolerance(error);
      return enough && !met;
    };
    DensityIntegrals found = integrate(diagram_, density_, options);
    expected_error_ = error * error;  // Newton's method converges quadratically
    if (enough) return found;
    options.tolerance = integral_tolerance(error);
  }
}

DensityIntegrals Evaluator::integrate_blend() {
  IntegrationOptions options;
  options.walls = true;
  options.threads = threads_;
  options.tolerance = most_share;
  DensityIntegrals uniform = integrate(diagram_, *uniform_, options);
  if (spread_ == 1) return uniform;
  DensityIntegrals result = integrate(diagram_, density_, options);
  blend(result, std::move(uniform), spread_);
  return result;
}

void Evaluator::measure(Iterate& at) {
  diagram_.set_weights({at.weights.data(), static_cast<std::size_t>(at.weights.size())});
  if (diagram_.domain().kind() == DomainKind::surface) diagram_.compute(true, true);
  at.cells = spread_ > 0 ? integrate_blend() : integrate_density();
  if (at.cells.walls.offset.empty()) return;
  if (diagram_.domain().is_periodic())
    join_images(diagram_.domain(), positions_, at);
  else
    at.conductance = conductances(diagram_, at.cells.walls, positions_);
}

Iterate Evaluator::evaluate(Vector weights) {
  WorkClock clock;
  Iterate result;
  weights.array() -= weights.mean();
  result.weights = std::move(weights);
  last_weights_ = result.weights;
  measure(result);
  for (const double m : result.cells.mass) result.empty += m > 0 ? 0 : 1;
  ++diagrams_;
  seconds_ += clock.lap();
  return result;
}

}  // namespace powercell
