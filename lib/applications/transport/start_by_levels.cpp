#include <algorithm>
#include <limits>
#include <numeric>

#include "lib/applications/transport/cell_points.hpp"
#include "lib/applications/transport/diagram_evaluator.hpp"
#include "lib/applications/transport/gathered.hpp"
#include "lib/applications/transport/phases.hpp"
#include "lib/applications/transport/seed_clusters.hpp"
#include "lib/applications/transport/soft_start.hpp"

namespace powercell {
namespace {

constexpr double enough = 0.3;  // min m_i / v_i of clusters from which their parts are placed
constexpr std::size_t points_per_part = 6;

/// The amount by which all parts have to be raised so that the least power distance of the middle of the cell
/// is the cluster's, (31g).
/// \param off  of the parts from the cluster
double to_middle(const Weighted& cell, std::span<const double> off, const Vector& weights, std::size_t d) {
  std::vector<double> middle(d);
  const double mass = std::accumulate(cell.mass.begin(), cell.mass.end(), 0.0);
  for (std::size_t k = 0; k < cell.positions.size(); ++k)
    middle[k % d] += cell.mass[k / d] / mass * cell.positions[k];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < off.size() / d; ++k) {
    double change = -weights[static_cast<Eigen::Index>(k)];
    for (std::size_t c = 0; c < d; ++c) change += off[k * d + c] * (off[k * d + c] - 2 * middle[c]);
    least = std::min(least, change);
  }
  return least;
}

/// About `count` of the points of a cell, which have the mass of all.
Weighted thinned(const Weighted& cell, std::size_t count, std::size_t d) {
  const std::size_t step = std::max<std::size_t>(1, cell.size() / count);
  Weighted some;
  for (std::size_t first = 0; first < cell.size(); first += step) {
    const std::size_t k = first + std::min(step, cell.size() - first) / 2,
                      end = std::min(first + step, cell.size());
    some.positions.insert(some.positions.end(), &cell.positions[k * d], &cell.positions[k * d] + d);
    some.mass.push_back(std::accumulate(&cell.mass[first], &cell.mass[first] + (end - first), 0.0));
  }
  return some;
}

/// Spreads the parts of each cluster over its cell, by a transport with an entropy.
/// \return their weights
/// \param weights  of the clusters
Vector spread_parts(const Domain& domain, const SeedLevel& clusters, const Vector& weights,
                    const SeedLevel& parts, int threads) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  const std::vector<Weighted> cells =
      cell_points(domain, clusters.positions, weights, points_per_part * parts.size());
  Vector result(static_cast<Eigen::Index>(parts.size()));
  for (std::size_t begin = 0, end = 0; begin < parts.size(); begin = end) {
    const std::uint32_t cluster = parts.parent[begin];
    while (end < parts.size() && parts.parent[end] == cluster) ++end;
    auto some = result.segment(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
    some.setConstant(weights[cluster]);
    const Weighted& cell = cells[cluster];
    if (end - begin == 1 || cell.size() == 0) continue;
    std::vector<double> off((end - begin) * d);
    for (std::size_t k = 0; k < off.size(); ++k)
      off[k] = parts.positions[begin * d + k] - clusters.positions[cluster * d + k % d];
    SoftStart start(
        d, [&](std::size_t count) { return std::vector{thinned(cell, count, d)}; }, off,
        {&parts.mass[begin], end - begin}, threads);
    start.solve();
    const Vector raised = start.weights();
    some.array() += raised.array() + to_middle(cell, off, raised, d);
  }
  return result;
}

/// Tries weights 0, with which no cell is empty in a periodic domain, and those of seeds moved into the box.
void try_unspread(Evaluator& evaluator, const Vector& target, Iterate& best) {
  Iterate plain = evaluator.evaluate(Vector::Zero(target.size()));
  if (plain.is_better(best, target)) best = std::move(plain);
  try_into_box(evaluator, target, best);
}

/// Solves level by level, from the coarsest to that of all seeds.
class Levels {
 public:
  Levels(SolveContext& context, DiagramEvaluator& evaluator)
      : context_(context), evaluator_(evaluator), options_(evaluator.options()) {
    options_.progress = [&](TransportStep step) {
      step.phase = TransportPhase::start;
      const auto& report = evaluator_.options().progress;
      return !report || report(step);
    };
  }

  /// \return weights of all seeds; none if the cells of a level cannot be solved
  Vector solve(const SeedClusters& clusters) {
    SeedLevel level = clusters.root();
    Vector weights = Vector::Zero(1);
    while (!clusters.is_finest(level)) {
      SeedLevel finer = clusters.finer(level);
      weights = spread_parts(evaluator_.domain(), level, weights, finer, options_.diagram.threads);
      level = std::move(finer);
      if (!clusters.is_finest(level) && !solve(level, weights)) return {};
    }
    Vector result(weights.size());
    for (std::size_t k = 0; k < level.size(); ++k)
      result[clusters.seed(level.node[k])] = weights[static_cast<Eigen::Index>(k)];
    return result;
  }

 private:
  bool solve(const SeedLevel& level, Vector& weights) {
    const Vector target = Eigen::Map<const Vector>(level.mass.data(), weights.size());
    Diagram& diagram = evaluator_.diagram();
    diagram.set_seeds({diagram.domain().dimension(), level.positions, {}});
    DiagramEvaluator cells(diagram, level.positions, {target, 1 - enough}, options_);
    if (evaluator_.spread() > 0) cells.set_spread(evaluator_.spread());
    options_.max_steps = context_.steps_left();
    SolveContext coarse(cells, options_, 1 - enough, true, target);
    Iterate at = cells.evaluate(std::move(weights));
    if (at.is_poor(target)) try_unspread(cells, target, at);
    if (at.empty > 0) ascend(coarse, at, true);
    if (at.empty == 0) approach(coarse, at, target, enough);
    weights = at.weights;
    context_.count_steps(coarse);
    evaluator_.count_diagrams(cells);
    return at.empty == 0;
  }

  SolveContext& context_;
  DiagramEvaluator& evaluator_;
  TransportOptions options_;
};

}  // namespace

void try_by_levels(SolveContext& context, Iterate& best) {
  if (context.evaluator().in_one_place() == nullptr) return;
  DiagramEvaluator& evaluator = *context.evaluator().in_one_place();
  const Domain& domain = evaluator.domain();
  const std::vector<double> positions = gathered(domain, evaluator.positions());
  // Equal masses, which take fewer steps than those that differ by orders.
  const Vector mass = Vector::Constant(context.target().size(), context.target().mean());
  const SeedClusters clusters(positions, mass, evaluator.dimension());
  // Levels have seeds of their own in the diagram.
  const auto restore = [&] {
    const Vector& last = evaluator.last_weights();
    evaluator.diagram().set_seeds(
        {domain.dimension(), evaluator.positions(), {last.data(), evaluator.size()}});
  };
  Vector weights;
  try {
    weights = Levels(context, evaluator).solve(clusters);
  } catch (...) {
    restore();
    throw;
  }
  restore();
  if (weights.size() > 0 && weights.allFinite()) {
    Iterate found = evaluator.evaluate(std::move(weights));
    if (found.is_better(best, context.target())) best = std::move(found);
  }
  TransportStep step;
  step.phase = TransportPhase::start;
  context.record(step, best, context.target());
}

}  // namespace powercell
