#include "lib/applications/transport/iterate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace powercell {
namespace {

/// What integrals may be off by, of what masses are: the value of the dual is off by about the square of the
/// latter. More is good enough for the first steps.
constexpr double least_share = 1e-4, most_share = 3e-3;
constexpr double rather_again = 4;  // times the tolerance needed

/// (1 - share) of a and share of b, entry by entry.
void blend(std::vector<double>& a, const std::vector<double>& b, double share) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = (1 - share) * a[k] + share * b[k];
}

/// Walls of a density and of a constant, which has all that the former has.
Adjacency blend(const Adjacency& a, Adjacency even, double share) {
  for (std::size_t i = 0; i + 1 < even.offset.size(); ++i) {
    const auto begin = a.neighbor.begin() + static_cast<std::ptrdiff_t>(a.offset[i]);
    const auto end = a.neighbor.begin() + static_cast<std::ptrdiff_t>(a.offset[i + 1]);
    for (std::uint64_t k = even.offset[i]; k < even.offset[i + 1]; ++k) {
      const auto found = std::lower_bound(begin, end, even.neighbor[k]);
      const bool both = found != end && *found == even.neighbor[k];
      even.wall[k] *= share;
      if (both) even.wall[k] += (1 - share) * a.wall[static_cast<std::size_t>(found - a.neighbor.begin())];
    }
  }
  return even;
}

/// Integrals of (31c). Centroids are left as they are: nobody asks for them on the way.
void blend(DensityIntegrals& integrals, DensityIntegrals even, double share) {
  blend(integrals.mass, even.mass, share);
  blend(integrals.second_moment, even.second_moment, share);
  integrals.walls = blend(integrals.walls, std::move(even.walls), share);
}

}  // namespace

double Iterate::error(const Vector& target) const {
  return (mass().array() / target.array() - 1).abs().maxCoeff();
}

double Iterate::quadrature_error(const Vector& target) const {
  if (cells.mass_error.empty()) return 0;
  return (Eigen::Map<const Vector>(cells.mass_error.data(), target.size()).array() / target.array())
      .maxCoeff();
}

double Iterate::least(const Vector& target) const {
  return (mass().array() / target.array()).minCoeff();
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

bool Evaluator::possible(const Vector& weights, const Vector& before) const {
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

void Evaluator::spread(double share) {
  spread_ = share;
  if (share > 0 && !even_) {
    const Domain& domain = diagram_.domain();
    // Rounding may take the mean of values that are all the largest beyond it.
    even_ = Density::constant(
        std::min(density_.total(domain, threads_) / domain.measure(), Density::largest_value));
  }
}

/// What integrals may be off by where masses are off by `error`.
double Evaluator::needed(double error) const {
  if (precise_) return least_share * goal_.tolerance;
  const double off = std::max(goal_.tolerance, std::min(1.0, error));
  return off * std::max(least_share, most_share * off);
}

/// Where the error turns out to be much less than was expected they are looked at again: formulas with kinks
/// cost ten times as much for two more digits.
DensityIntegrals Evaluator::integrate_as_needed() {
  IntegrationOptions options;
  options.walls = true;
  options.threads = threads_;
  options.tolerance = needed(density_.is_exact() ? 0 : expected_);
  while (true) {
    double error = 0;
    bool enough = true;
    options.walls_if = [&](std::span<const double> mass) {
      const Eigen::Map<const Vector> found(mass.data(), goal_.target.size());
      error = (found.array() / goal_.target.array() - 1).abs().maxCoeff();
      const bool met = error < goal_.tolerance;
      enough = options.tolerance <= (met ? 1 : rather_again) * needed(error);
      return enough && !met;
    };
    DensityIntegrals found = integrate(diagram_, density_, options);
    expected_ = error * error;
    if (enough) return found;
    options.tolerance = needed(error);
  }
}

DensityIntegrals Evaluator::integrate_blend() {
  IntegrationOptions options;
  options.walls = true;
  options.threads = threads_;
  options.tolerance = most_share;
  DensityIntegrals even = integrate(diagram_, *even_, options);
  if (spread_ == 1) return even;
  DensityIntegrals result = integrate(diagram_, density_, options);
  blend(result, std::move(even), spread_);
  return result;
}

void Evaluator::measure(Iterate& at) {
  diagram_.set_weights({at.weights.data(), static_cast<std::size_t>(at.weights.size())});
  if (diagram_.domain().kind() == DomainKind::surface) diagram_.compute(true, true);
  at.cells = spread_ > 0 ? integrate_blend() : integrate_as_needed();
  if (!at.cells.walls.offset.empty()) at.conductance = conductances(diagram_, at.cells.walls, positions_);
}

Iterate Evaluator::evaluate(Vector weights) {
  const auto start = std::chrono::steady_clock::now();
  Iterate result;
  weights.array() -= weights.mean();
  result.weights = std::move(weights);
  last_ = result.weights;
  measure(result);
  for (const double m : result.cells.mass) result.empty += m > 0 ? 0 : 1;
  ++count_;
  seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace powercell
