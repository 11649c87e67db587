#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/applications/transport/assignment.hpp"
#include "lib/applications/transport/clusters.hpp"
#include "lib/applications/transport/domain_parts.hpp"
#include "lib/applications/transport/phases.hpp"

namespace powercell {
namespace {

constexpr std::uint32_t most_parts = 32;  // more are joined
// Clusters of the coarsest level, and seeds per cluster.
const std::size_t few_seeds = getenv("T_FEW") ? atoi(getenv("T_FEW")) : 150, per_cluster = getenv("T_PER") ? atoi(getenv("T_PER")) : 8;
constexpr double level_tolerance = 0.1;  // of the masses of clusters
constexpr int rounds = 4;                // of shares and potentials, which depend on each other
// Every seed takes part in the potential of every part, with this share, and large masses with less than
// their own: their cells are round, not slabs.
const double common_share = 1e-2, mass_power = getenv("T_POW") ? atof(getenv("T_POW")) : 0.25;
const double cluster_power = getenv("T_CP") ? atof(getenv("T_CP")) : 0.5;
const double lift = getenv("T_LIFT") ? atof(getenv("T_LIFT")) : 1.5;

/// The seeds of one level.
struct Level {
  std::vector<double> positions;  ///< relative to the middle of the domain
  Vector mass;
  Clusters clusters;  ///< of these seeds; the seeds of the next coarser level
};

Level coarser(const Level& fine, std::size_t d) {
  Level level;
  level.positions.resize(fine.clusters.size() * d);
  level.mass = Vector::Zero(static_cast<Eigen::Index>(fine.clusters.size()));
  for (std::size_t k = 0; k < fine.clusters.size(); ++k) {
    double& mass = level.mass[static_cast<Eigen::Index>(k)];
    for (const std::uint32_t i : fine.clusters[k]) mass += fine.mass[i];
    for (const std::uint32_t i : fine.clusters[k])
      for (std::size_t c = 0; c < d; ++c)
        level.positions[k * d + c] += fine.mass[i] / mass * fine.positions[i * d + c];
  }
  return level;
}

/// Chooses clusters: their sizes lie between the numbers of their seeds and the masses.
void divide(Level& level, std::size_t d, std::size_t count) {
  const Vector size = (level.mass / level.mass.maxCoeff()).array().pow(cluster_power);
  level.clusters = cluster_seeds(level.positions, d, {size.data(), level.positions.size() / d}, count);
}

/// Levels from the finest to the coarsest, whose seeds are one cluster.
std::vector<Level> levels_of(Level finest, std::size_t d) {
  std::vector<Level> levels{std::move(finest)};
  while (static_cast<std::size_t>(levels.back().mass.size()) > few_seeds) {
    divide(levels.back(), d, static_cast<std::size_t>(levels.back().mass.size()) / per_cluster);
    levels.push_back(coarser(levels.back(), d));
  }
  divide(levels.back(), d, 1);
  return levels;
}

/// Potentials of the seeds of a cluster, from its potential and cell.
class ClusterPotential {
 public:
  ClusterPotential(const Level& level, std::size_t d, const std::vector<std::uint32_t>& seeds,
                   const std::vector<PartOfCell>& parts, const Place& at)
      : level_(level), d_(d), seeds_(seeds), parts_(parts), at_(at) {
    for (const std::uint32_t i : seeds_) supply_.push_back(level.mass[i]);
    share_.assign(1, supply_);
    gain_.assign(parts.size(), std::vector<double>(seeds.size()));
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (std::size_t k = 0; k < seeds_.size(); ++k)
        gain_[p][k] = parts_[p].where.mean.dot(place(level_.positions, seeds_[k], d_) - at_);
    price_.assign(parts_.size(), 0);
    for (int round = 0; round < rounds; ++round) {
      assign();
      if (round + 1 < rounds) bend();
      if (parts_.size() == 1) break;
    }
  }

  double of(std::size_t k) const {
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < parts_.size(); ++p) best = std::max(best, gain_[p][k] - price_[p]);
    return best;
  }
  double share(std::size_t p, std::size_t k) const { return share_[p][k]; }

 private:
  void assign() {
    if (parts_.size() == 1) return;
    double mass = 0, supply = 0, mean = 0;
    for (const PartOfCell& part : parts_) mass += part.mass;
    for (const double m : supply_) supply += m;
    std::vector<double> room;
    for (const PartOfCell& part : parts_) room.push_back(part.mass / mass * supply);
    Assignment assignment(gain_, supply_, room);
    share_ = assignment.share();
    price_ = assignment.prices();
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (std::isfinite(price_[p])) mean += parts_[p].mass / mass * price_[p];
    for (double& price : price_) price -= mean;
  }

  /// Adds the second order, of the transport from the seeds of a part to the cell there.
  void bend() {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      NormalSum sum(at_);
      for (std::size_t k = 0; k < seeds_.size(); ++k)
        sum.add(std::pow(supply_[k] / supply_[0], mass_power) * (share_[p][k] / supply_[k] + common_share),
                place(level_.positions, seeds_[k], d_));
      const Normal seeds = sum.normal(), &cell = parts_[p].where;
      const Eigen::Matrix3d map = linear_transport(seeds, cell);
      for (std::size_t k = 0; k < seeds_.size(); ++k) {
        const Place y = place(level_.positions, seeds_[k], d_), u = y - seeds.mean;
        gain_[p][k] = cell.mean.dot(y - at_) + u.dot(map * u) / 2 + lift * (map * seeds.covariance).trace();
      }
    }
  }

  const Level& level_;
  std::size_t d_;
  const std::vector<std::uint32_t>& seeds_;
  const std::vector<PartOfCell>& parts_;
  Place at_;
  std::vector<double> supply_, price_;
  std::vector<std::vector<double>> gain_, share_;  // part by part, a value for each seed
};

/// The solution of a level: potentials (31d) of its seeds, and their cells.
struct Solution {
  Vector potential;
  std::vector<std::vector<PartOfCell>> cells;
};

/// Potentials of the seeds of a level from those of the clusters.
Vector refine(const Level& level, std::size_t d, const std::vector<double>& positions, const Solution& coarse,
              std::vector<PartShare>& shares) {
  Vector potential(level.mass.size());
  shares.clear();
  for (std::size_t c = 0; c < level.clusters.size(); ++c) {
    const std::vector<std::uint32_t>& seeds = level.clusters[c];
    const ClusterPotential of(level, d, seeds, coarse.cells[c], place(positions, c, d));
    for (std::size_t k = 0; k < seeds.size(); ++k) {
      potential[seeds[k]] = coarse.potential[static_cast<Eigen::Index>(c)] + of.of(k);
      for (std::size_t p = 0; p < coarse.cells[c].size(); ++p)
        if (of.share(p, k) > 0) shares.push_back({coarse.cells[c][p].part, seeds[k], of.share(p, k)});
    }
  }
  return potential;
}

class LevelsSolver {
 public:
  LevelsSolver(SolveContext& context, Place middle)
      : context_(context),
        domain_(context.evaluator().diagram().domain()),
        d_(static_cast<std::size_t>(domain_.dimension())),
        middle_(std::move(middle)),
        parts_(domain_parts(domain_)) {}

  Vector start(std::vector<PartShare>& shares) {
    Level finest{moved(context_.evaluator().positions(), -1), context_.target(), {}};
    const std::vector<Level> levels = levels_of(std::move(finest), d_);
    Solution solution = whole(levels.back());
    std::vector<double> positions = coarser(levels.back(), d_).positions;
    for (std::size_t l = levels.size() - 1;; --l) {
      const Level& level = levels[l];
      const Vector potential = refine(level, d_, positions, solution, shares);
      Vector weights(potential.size());
      for (Eigen::Index i = 0; i < weights.size(); ++i)
        weights[i] =
            place(level.positions, static_cast<std::size_t>(i), d_).squaredNorm() - 2 * potential[i];
      if (l == 0 || !weights.allFinite()) return weights;
      solution = solve(level, weights, shares);
      positions = level.positions;
    }
  }

 private:
  std::vector<double> moved(std::span<const double> positions, double sign) const {
    std::vector<double> result(positions.begin(), positions.end());
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] += sign * middle_[static_cast<Eigen::Index>(k % d_)];
    return result;
  }

  std::vector<std::vector<PartOfCell>> cells(Evaluator& evaluator, std::span<const double> mass) {
    auto result = parts_of_cells(evaluator.cells(), mass, parts_);
    for (auto& cell : result)
      for (PartOfCell& part : cell) part.where.mean -= middle_;
    return result;
  }

  /// The solution for one seed.
  Solution whole(const Level& coarsest) {
    Level one = coarser(coarsest, d_);
    Diagram diagram(context_.evaluator().diagram().device(), domain_, context_.options().diagram);
    const std::vector<double> positions = moved(one.positions, 1);
    diagram.set_seeds({static_cast<int>(d_), positions, {}});
    Evaluator evaluator(diagram, context_.options().density, positions, {one.mass, level_tolerance}, 0);
    const std::vector<double> mass{one.mass.sum()};
    std::vector<std::vector<PartOfCell>> cell = cells(evaluator, mass);
    if (parts_.count > most_parts) {
      join_small(parts_, cell[0], most_parts);
      cell = cells(evaluator, mass);
    }
    context_.evaluator().add_work(evaluator);
    return {Vector::Zero(1), cell};
  }

  Solution solve(const Level& level, const Vector& weights, const std::vector<PartShare>& shares) {
    TransportOptions options = context_.options();
    options.progress = [&](const TransportStep& step) {
      context_.record_level(step);
      return true;
    };
    Diagram diagram(context_.evaluator().diagram().device(), domain_, options.diagram);
    const std::vector<double> positions = moved(level.positions, 1);
    diagram.set_seeds({static_cast<int>(d_), positions, {}});
    Evaluator evaluator(diagram, options.density, positions, {level.mass, level_tolerance}, 0);
    SolveContext inner(evaluator, options, level_tolerance, true, level.mass);
    inner.set_shares(shares);
    Iterate at = evaluator.evaluate(weights);
    solve_current_density(inner, at);
    if (at.empty > 0) at = evaluator.evaluate(inner.best());
    const Cells& cells_now = evaluator.cells();
    Solution result;
    result.cells = parts_of_cells(cells_now, at.cells.mass, parts_);
    for (auto& cell : result.cells)
      for (PartOfCell& part : cell) part.where.mean -= middle_;
    result.potential.resize(level.mass.size());
    for (Eigen::Index i = 0; i < level.mass.size(); ++i)
      result.potential[i] =
          (place(level.positions, static_cast<std::size_t>(i), d_).squaredNorm() - at.weights[i]) / 2;
    context_.evaluator().add_work(evaluator);
    return result;
  }

  SolveContext& context_;
  const Domain& domain_;
  std::size_t d_;
  Place middle_;
  DomainParts parts_;
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
  Place middle = Place::Zero();
  for (std::size_t c = 0; c < static_cast<std::size_t>(domain.dimension()); ++c)
    middle[static_cast<Eigen::Index>(c)] = domain.low()[c] / 2 + domain.high()[c] / 2;
  std::vector<PartShare> shares;
  const Vector weights = LevelsSolver(context, middle).start(shares);
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
