#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "lib/applications/transport/gathered.hpp"
#include "lib/applications/transport/phases.hpp"

namespace powercell {
namespace {

constexpr double smallest_fraction = 1.0 / 16;  // of the given weights that is tried
constexpr double room = 0.9;                    // part of the domain's box into which seeds are moved
// Contraction of the moved seeds towards the mean of the density from one attempt to the next, and attempts.
constexpr double contraction = 0.8;
constexpr int most_attempts = 4;

using Place = Eigen::Vector3d;  // third coordinate 0 in 2D

Place place_of(std::span<const double> positions, std::size_t i, std::size_t d) {
  Place p = Place::Zero();
  for (std::size_t c = 0; c < d; ++c) p[static_cast<Eigen::Index>(c)] = positions[i * d + c];
  return p;
}

/// The affine map from seeds p = middle + u to y = center + A u, about which their cells are wanted.
struct Move {
  Place middle = Place::Zero(), center = Place::Zero();
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();  ///< A: symmetric, positive definite
};

/// (31a) without the squared distance from the center to the middle: that constant would take all digits of
/// the weights of seeds far away.
Vector weights_of_moved_seeds(std::span<const double> positions, std::size_t d, const Move& move) {
  Vector weights(static_cast<Eigen::Index>(positions.size() / d));
  const Eigen::Matrix3d shrunk = Eigen::Matrix3d::Identity() - move.linear;
  const Place away = move.middle - move.center;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const Place u = place_of(positions, static_cast<std::size_t>(i), d) - move.middle;
    weights[i] = u.dot(shrunk * u + 2 * away);
  }
  return weights;
}

/// Maps the bounding box of the seeds into that of the domain, keeping proportions; about where it is along
/// periods.
/// \param low, high  the box of the seeds
Move into_box(const Domain& domain, const std::vector<double>& low, const std::vector<double>& high) {
  Move move;
  double scale = 0;
  for (std::size_t c = 0; c < low.size(); ++c) {
    const auto k = static_cast<Eigen::Index>(c);
    move.middle[k] = low[c] / 2 + high[c] / 2;
    const bool bounded = domain.periods()[c] == std::array<double, 3>{};
    move.center[k] = bounded ? domain.low()[c] / 2 + domain.high()[c] / 2 : move.middle[k];
    const double extent = domain.high()[c] - domain.low()[c];
    if (extent > 0) scale = std::max(scale, (high[c] - low[c]) / (room * extent));
  }
  if (scale > 0) move.linear /= scale;
  return move;
}

/// Mean and covariance of a distribution.
struct Normal {
  Place mean = Place::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

Normal normal_of(std::span<const double> positions, std::size_t d, const Vector& mass) {
  Normal normal;
  const double sum = mass.sum();
  const auto each = [&](const auto& body) {
    for (Eigen::Index i = 0; i < mass.size(); ++i)
      if (mass[i] > 0) body(place_of(positions, static_cast<std::size_t>(i), d), mass[i] / sum);
  };
  each([&](const Place& p, double share) { normal.mean += share * p; });
  each([&](const Place& p, double share) {
    normal.covariance += share * (p - normal.mean) * (p - normal.mean).transpose();
  });
  return normal;
}

/// Mean and covariance of the density: from the centroids of the cells, plus the second moments about these,
/// spread evenly over the axes.
Normal normal_of(const Iterate& at, std::span<const double> positions, std::size_t d) {
  Normal normal = normal_of(at.cells.centroid, d, at.mass());
  double within = 0;
  for (Eigen::Index i = 0; i < at.mass().size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!(at.mass()[i] > 0)) continue;
    const Place to_seed = place_of(at.cells.centroid, k, d) - place_of(positions, k, d);
    within += std::max(0.0, at.cells.second_moment[k] - at.mass()[i] * to_seed.squaredNorm());
  }
  const auto size = static_cast<Eigen::Index>(d);
  normal.covariance.topLeftCorner(size, size).diagonal().array() +=
      within / at.mass().sum() / static_cast<double>(d);
  return normal;
}

Eigen::Matrix3d power_of(const Eigen::Matrix3d& symmetric, double exponent) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of(symmetric);
  // Directions that the seeds do not span are left out.
  const double least = 1e-12 * of.eigenvalues().cwiseAbs().maxCoeff();
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 0; k < 3; ++k)
    if (of.eigenvalues()[k] > least) value[k] = std::pow(of.eigenvalues()[k], exponent);
  return of.eigenvectors() * value.asDiagonal() * of.eigenvectors().transpose();
}

/// Maps the seeds, weighted by their masses, to the mean and covariance of the density: (31b), the optimal
/// transport between normal distributions.
Move onto_density(const Normal& seeds, const Normal& density) {
  const Eigen::Matrix3d root = power_of(seeds.covariance, 0.5), inverse = power_of(seeds.covariance, -0.5);
  return {seeds.mean, density.mean, inverse * power_of(root * density.covariance * root, 0.5) * inverse};
}

/// Tries weights as if the seeds were moved onto the density, and keeps the best. If the density has an edge,
/// seeds spread in another shape lie beyond it until they are contracted towards the mean.
void try_on_density(Evaluator& evaluator, const Vector& target, Iterate& best) {
  const std::size_t d = evaluator.dimension();
  const std::span<const double> positions = evaluator.positions();
  Move move = onto_density(normal_of(positions, d, target), normal_of(best, positions, d));
  for (int k = 0; k < most_attempts && best.least(target) < poor_share; ++k, move.linear *= contraction) {
    const Vector weights = weights_of_moved_seeds(positions, d, move);
    if (!weights.allFinite()) return;  // no cell has mass, or squares overflow
    Iterate found = evaluator.evaluate(weights);
    if (found.is_better(best, target)) best = std::move(found);
  }
}

}  // namespace

void try_into_box(Evaluator& evaluator, const Vector& target, Iterate& best) {
  std::vector<double> low = evaluator.low(), high = evaluator.high(), positions;
  std::span<const double> given = evaluator.positions();
  if (evaluator.domain().is_periodic() && evaluator.in_one_place() != nullptr) {
    given = positions = gathered(evaluator.domain(), given);
    low.assign(given.begin(), given.begin() + static_cast<std::ptrdiff_t>(low.size()));
    high = low;
    for (std::size_t k = 0; k < given.size(); ++k) {
      low[k % low.size()] = std::min(low[k % low.size()], given[k]);
      high[k % low.size()] = std::max(high[k % low.size()], given[k]);
    }
  }
  const Move move = into_box(evaluator.domain(), low, high);
  const Vector weights = weights_of_moved_seeds(given, evaluator.dimension(), move);
  if (evaluator.all().any(!weights.allFinite())) return;
  Iterate found = evaluator.evaluate(weights);
  if (found.is_better(best, target)) best = std::move(found);
}

Iterate find_start(SolveContext& context, const Vector& weights) {
  Evaluator& evaluator = context.evaluator();
  const Vector& target = context.target();
  Iterate best = evaluator.evaluate(weights);
  const auto attempt = [&](const Vector& trial) {
    Iterate found = evaluator.evaluate(trial);
    if (found.empty < best.empty) best = std::move(found);
    return best.empty == 0;
  };
  const auto search = [&] {
    if (best.empty == 0) return;
    const Vector centred = best.weights;
    const bool weighted = best.all->any(!centred.isZero(0));
    for (double t = 0.5; weighted && t >= smallest_fraction; t /= 2)
      if (attempt(t * centred)) return;
    if (weighted) attempt(Vector::Zero(centred.size()));
  };
  search();
  if (best.is_poor(target)) try_into_box(evaluator, target, best);
  if (evaluator.density_varies() && best.least(target) < poor_share) try_on_density(evaluator, target, best);
  TransportStep step;
  step.phase = TransportPhase::start;
  context.record(step, best, target);
  if (best.is_poor(target)) try_by_levels(context, best);
  try_on_parts(context, best);
  return best;
}

}  // namespace powercell
