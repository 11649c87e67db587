#include "lib/applications/transport/evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/base/work_clock.hpp"

namespace powercell {
namespace {

/// Per coordinate the greatest of the values times a sign.
std::vector<double> ends(std::span<const double> positions, std::size_t d, double sign) {
  std::vector<double> result(d, -std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < positions.size(); ++k)
    result[k % d] = std::max(result[k % d], sign * positions[k]);
  return result;
}

}  // namespace

double Iterate::error(const Vector& target) const {
  return all->greatest_of((mass().array() / target.array() - 1).abs());
}

double Iterate::quadrature_error(const Vector& target) const {
  if (cells.mass_error.empty()) return 0;
  return (Eigen::Map<const Vector>(cells.mass_error.data(), target.size()).array() / target.array())
      .maxCoeff();
}

Vector Iterate::rounding() const {
  const Adjacency& walls = cells.walls;
  const auto n = static_cast<std::size_t>(weights.size());
  Vector sum = Vector::Zero(weights.size());
  if (conductance.empty()) return sum;
  const auto weight = [&](std::size_t j) {
    return j < n ? weights[static_cast<Eigen::Index>(j)] : beyond[static_cast<Eigen::Index>(j - n)];
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::uint64_t k = walls.offset[i]; k < walls.offset[i + 1]; ++k)
      sum[static_cast<Eigen::Index>(i)] +=
          conductance[k] * (std::abs(weight(i)) + std::abs(weight(walls.neighbor[k])));
  return std::numeric_limits<double>::epsilon() * sum;
}

double Iterate::least(const Vector& target) const {
  return all->least_of(mass().array() / target.array());
}

Laplacian Iterate::laplacian(std::span<const double> shift) const {
  return make_laplacian(cells.walls.offset, cells.walls.neighbor, conductance, shift,
                        static_cast<std::size_t>(beyond.size()));
}

double Iterate::primal() const {
  return all->sum_of(Eigen::Map<const Vector>(cells.second_moment.data(), weights.size()));
}

double Iterate::dual(const Vector& target) const {
  return primal() + all->dot(weights, gradient(target));
}

Evaluator::Evaluator(Domain domain, std::span<const double> positions, const AllSeeds& all)
    : domain_(std::move(domain)),
      positions_(positions),
      dimension_(static_cast<std::size_t>(domain_.dimension())),
      all_(all),
      count_(all.count(positions.size() / dimension_)),
      low_(all.greatest(ends(positions, dimension_, -1))),
      high_(all.greatest(ends(positions, dimension_, 1))) {
  for (double& x : low_) x = -x;
}

bool Evaluator::plausible(const Vector& weights, const Vector& before) const {
  const auto range = [&](const Vector& w) { return all_.greatest_of(w) - all_.least_of(w); };
  double square = 0;
  for (std::size_t c = 0; c < dimension_; ++c) {
    const double low = std::min(domain_.low()[c], low_[c]), high = std::max(domain_.high()[c], high_[c]);
    square += (high - low) * (high - low);
  }
  return range(weights) <= 4 * std::max(square, range(before));
}

Iterate Evaluator::evaluate(Vector weights) {
  WorkClock clock;
  Iterate result;
  result.all = &all_;
  weights.array() -= all_.sum_of(weights) / static_cast<double>(count_);
  result.weights = std::move(weights);
  measure(result);
  std::size_t empty = 0;
  for (const double m : result.cells.mass) empty += m > 0 ? 0 : 1;
  result.empty = all_.count(empty);
  ++diagrams_;
  seconds_ += clock.lap();
  return result;
}

}  // namespace powercell
