#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/applications/transport/assignment.hpp"
#include "lib/applications/transport/clusters.hpp"
#include "lib/applications/transport/domain_parts.hpp"
#include "lib/applications/transport/domain_points.hpp"
#include "lib/applications/transport/phases.hpp"
#include "lib/applications/transport/soft_transport.hpp"

namespace powercell {
namespace {

double env(const char* n, double v) { return getenv(n) ? atof(getenv(n)) : v; }
const std::size_t few_seeds = env("T_FEW", 150), per_cluster = env("T_PER", 16);
const double points_per_seed = env("T_PTS", 4);
const double cluster_power = env("T_CP", .5);
const int sweeps = env("T_SW", 4);
const double cool = env("T_COOL", 2), last_entropy = env("T_ENT", 0.7), level_entropy = env("T_LENT", 1), massy = env("T_MASSY", 0);
const bool balance = env("T_BAL", 1);
const double least_points = env("T_MINP", 500);

/// The seeds of one level.
struct Level {
  Weighted seeds;
  Clusters clusters;  ///< of these seeds; the seeds of the next coarser level
};

/// Divides the seeds into clusters, whose sizes lie between the numbers of their seeds and the masses.
Level coarser(Level& fine, std::size_t d, std::size_t count) {
  std::vector<double> size = fine.seeds.mass;
  const double largest = *std::ranges::max_element(size);
  for (double& m : size) m = std::pow(m / largest, cluster_power);
  fine.clusters = cluster_seeds(fine.seeds.positions, d, size, count);
  const std::size_t n = fine.clusters.size();
  Level level{{std::vector<double>(n * d), std::vector<double>(n), std::vector<double>(n)}, {}};
  for (std::size_t k = 0; k < n; ++k) {
    double& mass = level.seeds.mass[k];
    for (const std::uint32_t i : fine.clusters[k]) mass += fine.seeds.mass[i];
    for (const std::uint32_t i : fine.clusters[k])
      for (std::size_t c = 0; c < d; ++c)
        level.seeds.positions[k * d + c] += fine.seeds.mass[i] / mass * fine.seeds.positions[i * d + c];
  }
  return level;
}

/// Levels from the finest to the coarsest.
std::vector<Level> levels_of(Weighted seeds, std::size_t d) {
  std::vector<Level> levels{{std::move(seeds), {}}};
  while (levels.back().seeds.size() > few_seeds)
    levels.push_back(coarser(levels.back(), d, levels.back().seeds.size() / per_cluster));
  return levels;
}

/// Mean and standard deviation.
struct Spread {
  std::vector<double> mean;
  double deviation = 0;
};

Spread spread_of(const Weighted& all, std::size_t d) {
  Spread result{std::vector<double>(d), 0};
  double mass = 0;
  for (const double m : all.mass) mass += m;
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

class SoftStart {
 public:
  SoftStart(const Domain& domain, std::span<const double> positions, const Vector& target)
      : domain_(domain), d_(static_cast<std::size_t>(domain.dimension())), parts_(domain_parts(domain)), positions_(positions) {
    const auto n = static_cast<std::size_t>(target.size());
    Weighted seeds{{positions.begin(), positions.end()}, {target.begin(), target.end()}, std::vector<double>(n)};
    of_domain_ = spread_of(domain_points(domain, static_cast<std::size_t>(least_points)).points, d_);
    const Spread of_seeds = spread_of(seeds, d_);
    scale_ = of_domain_.deviation / of_seeds.deviation;
    place_about(seeds.positions, of_seeds.mean, scale_);
    levels_ = levels_of(std::move(seeds), d_);
    heat_ = 2 * of_domain_.deviation * of_domain_.deviation;
  }

  void solve() {
    for (std::size_t l = levels_.size(); l-- > 0;) {
      Weighted& level = levels_[l].seeds;
      set_points(level.size());
      if (l + 1 < levels_.size()) {
        to_points(levels_[l + 1].seeds);
        to_seeds(level, false);
      }
      for (int k = 0; k < 200; ++k) {
        double entropy = 0;
        for (int s = 0; s < sweeps; ++s) {
          entropy = to_points(level);
          to_seeds(level, s + 1 == sweeps && balance);
        }
        if (getenv("T_LOG")) printf("   level %zu n %zu heat %g entropy %g\n", l, level.size(), heat_, entropy);
        if (entropy < (l == 0 ? last_entropy : level_entropy)) break;
        heat_ /= cool;
      }
    }
    to_points(levels_[0].seeds);
    to_seeds(levels_[0].seeds, true);
  }

  Vector weights() const {
    const Weighted& finest = levels_[0].seeds;
    Vector weights(static_cast<Eigen::Index>(finest.size()));
    for (std::size_t i = 0; i < finest.size(); ++i) {
      double square = 0, from_mean = 0;
      for (std::size_t c = 0; c < d_; ++c) {
        const double y = finest.positions[i * d_ + c];
        square += y * y;
        from_mean += (positions_[i * d_ + c] - of_domain_.mean[c]) * (positions_[i * d_ + c] - of_domain_.mean[c]);
      }
      double w = finest.weights[i];
      if (massy != 0) w += massy * heat_ * std::log(finest.mass[i]);
      weights[static_cast<Eigen::Index>(i)] = from_mean - (square - w) / scale_;
    }
    return weights;
  }
  const std::vector<PartShare>& shares() const { return shares_; }

 private:
  void set_points(std::size_t n) {
    const DomainPoints all = domain_points(domain_, static_cast<std::size_t>(std::max(least_points, points_per_seed * double(n))));
    points_.assign(parts_.count, {});
    for (std::size_t k = 0; k < all.region.size(); ++k) {
      Weighted& part = points_[parts_.of_region[all.region[k]]];
      part.positions.insert(part.positions.end(), &all.points.positions[k * d_], &all.points.positions[k * d_] + d_);
      part.mass.push_back(all.points.mass[k]);
      part.weights.push_back(0);
    }
    room_.clear();
    for (Weighted& part : points_) {
      place_about(part.positions, of_domain_.mean, 1);
      room_.push_back(std::accumulate(part.mass.begin(), part.mass.end(), 0.0));
    }
  }

  double to_points(const Weighted& seeds) {
    double entropy = 0;
    for (std::size_t p = 0; p < points_.size(); ++p) entropy += room_[p] * soften(seeds, points_[p], d_, heat_);
    return entropy / domain_.measure();
  }

  void to_seeds(Weighted& seeds, bool balanced) {
    const std::size_t n = seeds.size();
    std::vector<std::vector<double>> gain;
    for (Weighted& part : points_) {
      soften(part, seeds, d_, heat_);
      gain.push_back(seeds.weights);
      for (double& g : gain.back()) g = -g;
    }
    std::vector<double> price(points_.size());
    if (balanced) {
      const double total = std::accumulate(seeds.mass.begin(), seeds.mass.end(), 0.0);
      std::vector<double> room = room_;
      for (double& m : room) m *= total / domain_.measure();
      Assignment assignment(gain, seeds.mass, room);
      price = assignment.prices();
      shares_.clear();
      for (std::uint32_t p = 0; p < points_.size(); ++p)
        for (std::uint32_t i = 0; i < n; ++i)
          if (assignment.share()[p][i] > 0) shares_.push_back({p, i, assignment.share()[p][i]});
    }
    for (std::size_t i = 0; i < n; ++i) {
      double most = -INFINITY, sum = 0;
      for (std::size_t p = 0; p < gain.size(); ++p) most = std::max(most, gain[p][i] - price[p]);
      for (std::size_t p = 0; p < gain.size(); ++p)
        sum += room_[p] / domain_.measure() * std::exp((gain[p][i] - price[p] - most) / heat_);
      seeds.weights[i] = -most - (balanced ? 0 : heat_ * std::log(sum));
    }
  }

  const Domain& domain_;
  std::size_t d_;
  DomainParts parts_;
  std::span<const double> positions_;
  Spread of_domain_;
  double scale_ = 1, heat_ = 1;
  std::vector<Level> levels_;
  std::vector<Weighted> points_;  // per part
  std::vector<double> room_;
  std::vector<PartShare> shares_;
};

/// The share of the mass that lies in wrong cells.
double misplaced(const Iterate& at, const Vector& target) {
  return at.gradient(target).lpNorm<1>() / 2 / target.sum();
}

}  // namespace

void try_on_parts(SolveContext& context, Iterate& best) {
  Evaluator& evaluator = context.evaluator();
  const Vector& target = context.target();
  const Domain& domain = evaluator.diagram().domain();
  if (!context.has_several_parts() || evaluator.density_varies() || misplaced(best, target) < 0.05) return;
  SoftStart start(domain, evaluator.positions(), target);
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
