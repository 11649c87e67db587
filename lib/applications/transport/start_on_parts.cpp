#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/applications/transport/assignment.hpp"
#include "lib/applications/transport/diagram_evaluator.hpp"
#include "lib/applications/transport/domain_parts.hpp"
#include "lib/applications/transport/domain_points.hpp"
#include "lib/applications/transport/phases.hpp"
#include "lib/applications/transport/seed_levels.hpp"
#include "lib/applications/transport/soft_transport.hpp"

namespace powercell {
namespace {

constexpr double little = 0.05;                 // share of the mass that may be misplaced without a new start
constexpr std::uint32_t most_parts = 32;        // more are joined
constexpr std::size_t most_shares = 4'000'000;  // seeds times parts; more take too much time and memory
constexpr std::size_t points_per_seed = 4, least_points = 500;
constexpr int sweeps = 4;  // at each temperature
constexpr double cooling = 2;
constexpr int most_coolings = 60;  // of a level: seeds at nearly one position stay shared
// Mean entropy of the shares of the seeds in a point at which a level ends.
constexpr double resolved_clusters = 0.7, resolved_seeds = 0.4;

/// Mean and standard deviation.
struct Spread {
  std::vector<double> mean;
  double deviation = 0;
};

Spread spread_of(const Weighted& all, std::size_t d) {
  Spread result{std::vector<double>(d), 0};
  const double mass = std::accumulate(all.mass.begin(), all.mass.end(), 0.0);
  for (std::size_t k = 0; k < all.positions.size(); ++k)
    result.mean[k % d] += all.mass[k / d] / mass * all.positions[k];
  for (std::size_t k = 0; k < all.positions.size(); ++k) {
    const double u = all.positions[k] - result.mean[k % d];
    result.deviation += all.mass[k / d] / mass * u * u;
  }
  result.deviation = std::sqrt(result.deviation);
  return result;
}

void place_about(std::vector<double>& positions, const std::vector<double>& mean, double scale) {
  for (std::size_t k = 0; k < positions.size(); ++k)
    positions[k] = (positions[k] - mean[k % mean.size()]) * scale;
}

/// Solves a transport with an entropy between seeds and points of the parts while the entropy decreases, from
/// few clusters of seeds to all. Seeds are moved and scaled to the mean and extent of the domain: that
/// changes their weights by a known function, and avoids large numbers for seeds far away.
class StartOnParts {
 public:
  StartOnParts(const Domain& domain, std::span<const double> positions, const Vector& target)
      : domain_(domain),
        d_(static_cast<std::size_t>(domain.dimension())),
        parts_(domain_parts(domain)),
        positions_(positions) {
    const DomainPoints points = domain_points(domain, least_points);
    join_small(parts_, points, most_parts);
    of_domain_ = spread_of(points.points, d_);
    Weighted seeds{{positions.begin(), positions.end()},
                   {target.begin(), target.end()},
                   std::vector<double>(static_cast<std::size_t>(target.size()))};
    const Spread of_seeds = spread_of(seeds, d_);
    scale_ = of_domain_.deviation / of_seeds.deviation;
    place_about(seeds.positions, of_seeds.mean, scale_);
    levels_ = seed_levels(std::move(seeds), d_);
    heat_ = 2 * of_domain_.deviation * of_domain_.deviation;
  }

  void solve() {
    for (std::size_t l = levels_.size(); l-- > 0;) {
      Weighted& level = levels_[l];
      set_points(level.size());
      if (l + 1 < levels_.size()) {
        to_points(levels_[l + 1]);
        to_seeds(level, false);
      }
      cool(level, l == 0 ? resolved_seeds : resolved_clusters);
    }
    to_points(levels_[0]);
    to_seeds(levels_[0], true);
  }

  /// (31d), for the seeds as given
  Vector weights() const {
    const Weighted& seeds = levels_[0];
    Vector weights(static_cast<Eigen::Index>(seeds.size()));
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      double moved = 0, given = 0;
      for (std::size_t c = 0; c < d_; ++c) {
        const double y = seeds.positions[i * d_ + c], p = positions_[i * d_ + c] - of_domain_.mean[c];
        moved += y * y;
        given += p * p;
      }
      weights[static_cast<Eigen::Index>(i)] = given - (moved - seeds.weights[i]) / scale_;
    }
    return weights;
  }
  std::vector<PartShare> shares() { return std::move(shares_); }

 private:
  void set_points(std::size_t seeds) {
    const DomainPoints all = domain_points(domain_, std::max(least_points, points_per_seed * seeds));
    points_.assign(parts_.count, {});
    for (std::size_t k = 0; k < all.points.size(); ++k) {
      Weighted& part = points_[parts_.of_region[all.region[k]]];
      const auto x = all.points.positions.begin() + static_cast<std::ptrdiff_t>(k * d_);
      part.positions.insert(part.positions.end(), x, x + static_cast<std::ptrdiff_t>(d_));
      part.mass.push_back(all.points.mass[k]);
      part.weights.push_back(0);
    }
    room_.clear();
    for (Weighted& part : points_) {
      place_about(part.positions, of_domain_.mean, 1);
      room_.push_back(std::accumulate(part.mass.begin(), part.mass.end(), 0.0));
    }
    const double sum = std::accumulate(room_.begin(), room_.end(), 0.0);
    for (double& share : room_) share /= sum;
  }

  void cool(Weighted& level, double resolved) {
    for (int k = 0; k < most_coolings; ++k) {
      double entropy = 0;
      for (int s = 1; s <= sweeps; ++s) {
        entropy = to_points(level);
        to_seeds(level, s == sweeps);
      }
      if (entropy < resolved) break;
      heat_ /= cooling;
    }
  }

  double to_points(const Weighted& seeds) {
    double entropy = 0;
    for (std::size_t p = 0; p < points_.size(); ++p)
      entropy += room_[p] * soften(seeds, points_[p], d_, heat_);
    return entropy;
  }

  /// \param balanced  with prices of the parts for which each part gets its mass
  void to_seeds(Weighted& seeds, bool balanced) {
    std::vector<std::vector<double>> gain;  // per part
    for (const Weighted& part : points_) {
      soften(part, seeds, d_, heat_);
      gain.push_back(seeds.weights);
      for (double& g : gain.back()) g = -g;
    }
    const std::vector<double> price =
        balanced ? prices(gain, seeds.mass) : std::vector<double>(points_.size());
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      double most = -std::numeric_limits<double>::infinity(), sum = 0;
      for (std::size_t p = 0; p < gain.size(); ++p) most = std::max(most, gain[p][i] - price[p]);
      for (std::size_t p = 0; p < gain.size(); ++p)
        sum += room_[p] * std::exp((gain[p][i] - price[p] - most) / heat_);
      seeds.weights[i] = -most - (balanced ? 0 : heat_ * std::log(sum));
    }
  }

  std::vector<double> prices(const std::vector<std::vector<double>>& gain, const std::vector<double>& mass) {
    const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
    std::vector<double> room = room_;
    for (double& m : room) m *= total;
    Assignment assignment(gain, mass, room);
    std::vector<double> result = assignment.prices();
    shares_.clear();
    for (std::uint32_t p = 0; p < points_.size(); ++p)
      for (std::uint32_t i = 0; i < mass.size(); ++i)
        if (assignment.share()[p][i] > 0) shares_.push_back({p, i, assignment.share()[p][i]});
    return result;
  }

  const Domain& domain_;
  std::size_t d_;
  DomainParts parts_;
  std::span<const double> positions_;
  Spread of_domain_;
  double scale_ = 1, heat_ = 0;
  std::vector<Weighted> levels_;  // from the finest to the coarsest
  std::vector<Weighted> points_;  // per part
  std::vector<double> room_;      // per part: its share of the domain's measure
  std::vector<PartShare> shares_;
};

}  // namespace

void try_on_parts(SolveContext& context, Iterate& best) {
  if (context.evaluator().in_one_place() == nullptr) return;
  DiagramEvaluator& evaluator = *context.evaluator().in_one_place();
  const Vector& target = context.target();
  const Domain& domain = evaluator.domain();
  const bool misplaced = best.gradient(target).lpNorm<1>() / 2 > little * target.sum();
  if (!context.has_several_parts() || evaluator.density_varies() || !misplaced) return;
  if (std::size_t{std::min(domain_parts(domain).count, most_parts)} * evaluator.size() > most_shares) return;
  StartOnParts start(domain, evaluator.positions(), target);
  start.solve();
  const Vector weights = start.weights();
  if (!weights.allFinite()) return;
  Iterate found = evaluator.evaluate(weights);
  if (found.dual(target) <= best.dual(target)) return;
  best = std::move(found);
  context.set_shares(start.shares());
  TransportStep step;
  step.phase = TransportPhase::start;
  context.record(step, best, target);
}

}  // namespace powercell
