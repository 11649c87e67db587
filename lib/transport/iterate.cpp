#include "lib/transport/iterate.hpp"

#include <chrono>
#include <cmath>

namespace powercell {

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

void Evaluator::measure(Iterate& at) {
  diagram_.set_weights({at.weights.data(), static_cast<std::size_t>(at.weights.size())});
  if (diagram_.domain().kind() == DomainKind::surface) diagram_.compute(true, true);
  at.cells = integrate(diagram_, density_, options_);
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
