#include <algorithm>
#include <array>
#include <cmath>

#include "lib/transport/course.hpp"

namespace powercell {
namespace {

constexpr double smallest_fraction = 1.0 / 16;  // of given weights that is tried
constexpr double room = 0.9;                    // of the domain's box that seeds are moved into

/// Weights that make the power diagram of the seeds p = s y + t the Voronoi diagram of y, with s and t such
/// that all y are in the domain's box: w = |p|² - s |y|², less the square of the way to the seeds' middle,
/// which is that of all and would leave no digits to those far away.
Vector weights_of_moved_seeds(const Domain& domain, std::span<const double> positions) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  const std::size_t n = positions.size() / d;
  std::array<double, 3> low{}, high{}, middle{}, center{};
  double scale = 0;
  for (std::size_t c = 0; c < d; ++c) {
    low[c] = high[c] = positions[c];
    for (std::size_t i = 0; i < n; ++i) {
      low[c] = std::min(low[c], positions[i * d + c]);
      high[c] = std::max(high[c], positions[i * d + c]);
    }
    middle[c] = low[c] / 2 + high[c] / 2;
    center[c] = domain.low()[c] / 2 + domain.high()[c] / 2;
    const double extent = domain.high()[c] - domain.low()[c];
    if (extent > 0) scale = std::max(scale, (high[c] - low[c]) / (room * extent));
  }
  Vector weights = Vector::Zero(static_cast<Eigen::Index>(n));
  if (scale == 0) return weights;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < d; ++c) {
      const double u = positions[i * d + c] - middle[c], away = middle[c] - center[c];
      weights[static_cast<Eigen::Index>(i)] += u * (u + 2 * away - u / scale);
    }
  return weights;
}

bool some_outside_box(const Domain& domain, std::span<const double> positions) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (positions[k] < domain.low()[k % d] || positions[k] > domain.high()[k % d]) return true;
  return false;
}

}  // namespace

Iterate find_start(Course& course, const Vector& weights) {
  Evaluator& evaluator = course.evaluator();
  Iterate best = evaluator.evaluate(weights);
  const auto attempt = [&](const Vector& trial) {
    Iterate found = evaluator.evaluate(trial);
    if (found.empty < best.empty) best = std::move(found);
    return best.empty == 0;
  };
  const auto search = [&] {
    if (best.empty == 0) return;
    const Vector centred = best.weights;
    const bool weighted = centred.cwiseAbs().maxCoeff() > 0;
    for (double t = 0.5; weighted && t >= smallest_fraction; t /= 2)
      if (attempt(t * centred)) return;
    if (weighted && attempt(Vector::Zero(centred.size()))) return;
    const Domain& domain = evaluator.diagram().domain();
    if (some_outside_box(domain, evaluator.positions()))
      attempt(weights_of_moved_seeds(domain, evaluator.positions()));
  };
  search();
  TransportStep step;
  step.phase = TransportPhase::start;
  course.accept(step, best, course.target());
  return best;
}

}  // namespace powercell
