#include <algorithm>
#include <cmath>
#include <map>

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

Vector soft_weights(const Domain& domain, std::span<const double> positions, const Vector& target,
                    std::vector<PartShare>& shares) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  const auto n = static_cast<std::size_t>(target.size());
  Weighted seeds{{positions.begin(), positions.end()}, {target.begin(), target.end()}, std::vector<double>(n)};
  const Spread of_domain = spread_of(domain_points(domain, static_cast<std::size_t>(least_points)).points, d);
  const Spread of_seeds = spread_of(seeds, d);
  const double scale = of_domain.deviation / of_seeds.deviation;
  place_about(seeds.positions, of_seeds.mean, scale);
  std::vector<Level> levels = levels_of(std::move(seeds), d);
  DomainPoints points;
  double heat = 2 * of_domain.deviation * of_domain.deviation;
  for (std::size_t l = levels.size(); l-- > 0;) {
    Weighted& level = levels[l].seeds;
    points = domain_points(domain, static_cast<std::size_t>(std::max(least_points, points_per_seed * double(level.size()))));
    place_about(points.points.positions, of_domain.mean, 1);
    if (l + 1 < levels.size()) {
      soften(levels[l + 1].seeds, points.points, d, heat);
      soften(points.points, level, d, heat);
    }
    for (int k = 0; k < 200; ++k) {
      double entropy = 0;
      for (int s = 0; s < sweeps; ++s) {
        entropy = soften(level, points.points, d, heat);
        soften(points.points, level, d, heat);
      }
      if (getenv("T_LOG")) printf("   level %zu n %zu heat %g entropy %g\n", l, level.size(), heat, entropy);
      if (entropy < (l == 0 ? last_entropy : level_entropy)) break;
      heat /= cool;
    }
  }
  Weighted& finest = levels[0].seeds;
  const DomainParts parts = domain_parts(domain);
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> of;
  soften(finest, points.points, d, heat);
  soften(points.points, finest, d, heat, [&](std::size_t i, std::uint32_t x, double share) {
    of[{parts.of_region[points.region[x]], static_cast<std::uint32_t>(i)}] += share * target[static_cast<Eigen::Index>(i)];
  });
  for (const auto& [k, m] : of)
    if (m > 1e-3 * target[k.second]) shares.push_back({k.first, k.second, m});
  Vector weights(target.size());
  for (std::size_t i = 0; i < n; ++i) {
    double square = 0, from_mean = 0;
    for (std::size_t c = 0; c < d; ++c) {
      const double y = finest.positions[i * d + c];
      square += y * y;
      from_mean += (positions[i * d + c] - of_domain.mean[c]) * (positions[i * d + c] - of_domain.mean[c]);
    }
    const double w = finest.weights[i] + massy * heat * std::log(finest.mass[i] / target.mean());
    weights[static_cast<Eigen::Index>(i)] = from_mean - (square - w) / scale;
  }
  return weights;
}

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
  std::vector<PartShare> shares;
  const Vector weights = soft_weights(domain, evaluator.positions(), target, shares);
  if (!weights.allFinite()) return;
  Iterate found = evaluator.evaluate(weights);
  if (found.dual(target) <= best.dual(target)) return;
  best = std::move(found);
  context.set_shares(std::move(shares));
  TransportStep step;
  step.phase = TransportPhase::start;
  context.record(step, best, target);
}

}  // namespace powercell
