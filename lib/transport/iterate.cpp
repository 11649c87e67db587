#include "lib/transport/iterate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace powercell {
namespace {

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
                     IntegrationOptions options)
    : diagram_(diagram),
      density_(density),
      positions_(positions),
      dimension_(static_cast<std::size_t>(diagram.domain().dimension())),
      options_(std::move(options)) {}

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
    even_ = Density::constant(density_.total(domain, options_.threads) / domain.measure());
  }
}

void Evaluator::measure(Iterate& at) {
  diagram_.set_weights({at.weights.data(), static_cast<std::size_t>(at.weights.size())});
  if (diagram_.domain().kind() == DomainKind::surface) diagram_.compute(true, true);
  if (spread_ > 0) {
    IntegrationOptions with_walls = options_;
    with_walls.walls_if = nullptr;
    if (spread_ < 1) at.cells = integrate(diagram_, density_, with_walls);
    DensityIntegrals even = integrate(diagram_, *even_, with_walls);
    if (spread_ < 1)
      blend(at.cells, std::move(even), spread_);
    else
      at.cells = std::move(even);
  } else {
    at.cells = integrate(diagram_, density_, options_);
  }
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
