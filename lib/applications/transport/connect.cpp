#include <algorithm>
#include <numeric>

#include "lib/applications/transport/cell_simplices.hpp"
#include "lib/applications/transport/diagram_evaluator.hpp"
#include "lib/applications/transport/phases.hpp"
#include "lib/applications/transport/power_tree.hpp"
#include "lib/base/disjoint_sets.hpp"

namespace powercell {
namespace {

constexpr double no_distance = std::numeric_limits<double>::infinity();
// A cell keeps this part of its mass, or of its target, when another group takes from it.
constexpr double kept = 0.5;
// Several groups may each take this part of one cell: they hardly ever take the same.
constexpr double little = 0.1;
// Groups times simplices; more take longer than an ascent.
constexpr std::size_t most_work = 20'000'000;

/// Groups of cells that walls connect; a starved cell is a group of its own.
struct Groups {
  std::vector<std::uint32_t> of;                    ///< per cell
  std::vector<std::vector<std::uint32_t>> members;  ///< per group
};

Groups groups_of(const Iterate& at, const Vector& target, double starved) {
  const auto n = static_cast<std::uint32_t>(at.cells.mass.size());
  const Adjacency& walls = at.cells.walls;
  const auto starves = [&](std::uint32_t i) {
    return at.cells.mass[i] < starved * target[static_cast<Eigen::Index>(i)];
  };
  DisjointSets sets(n);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint64_t k = walls.offset[i]; k < walls.offset[i + 1]; ++k)
      if (at.conductance[k] > 0 && !starves(i) && !starves(walls.neighbor[k]))
        sets.unite(i, walls.neighbor[k]);
  Groups groups;
  groups.of.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t root = sets.root(i);  // the least of its set
    if (root == i) groups.members.emplace_back();
    groups.of[i] = root == i ? static_cast<std::uint32_t>(groups.members.size() - 1) : groups.of[root];
    groups.members[groups.of[i]].push_back(i);
  }
  return groups;
}

/// Raises groups one after the other, each against the cells as those before it left them.
class Raising {
 public:
  Raising(SolveContext& context, const Iterate& at, const Vector& target, const Groups& groups,
          const Cells& cells, double starved)
      : target_(target),
        starved_(starved),
        tolerance_(context.tolerance()),
        positions_(context.evaluator().positions()),
        d_(static_cast<std::size_t>(cells.dimension)),
        groups_(groups),
        simplices_(cut_into_simplices(cells, at.cells.mass)),
        given_(at.weights),
        weights_(at.weights),
        mass_(at.cells.mass),
        need_(groups.members.size()),
        owner_power_(simplices_.vertex.size()),
        holder_(simplices_.vertex.size()),
        touched_(at.cells.mass.size()) {
    for (std::size_t i = 0; i < mass_.size(); ++i)
      need_[groups.of[i]] += target_[static_cast<Eigen::Index>(i)] - mass_[i];
    for (std::size_t v = 0; v < holder_.size(); ++v) {
      const std::uint32_t owner = simplices_.owner[v];
      owner_power_[v] = power_distance(positions_, weights(), d_, owner, simplices_.vertex[v]);
      holder_[v] = groups.of[owner];
    }
  }

  std::size_t simplices() const { return simplices_.simplex.size(); }
  const Vector& raised() const { return weights_; }

  /// Raises the groups that lack mass, the neediest first.
  /// \return whether any was raised
  bool raise_all() {
    std::vector<std::uint32_t> order(need_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return need_[a] > need_[b]; });
    bool any = false;
    for (const std::uint32_t group : order) any |= lacks_mass(group) && raise(group);
    return any;
  }

 private:
  std::span<const double> weights() const { return {given_.data(), mass_.size()}; }

  bool lacks_mass(std::uint32_t group) const {
    double least = no_distance;
    for (const std::uint32_t i : groups_.members[group])
      least = std::min(least, target_[static_cast<Eigen::Index>(i)]);
    return need_[group] > 0.1 * tolerance_ * least;
  }

  /// Per vertex the amount by which the group must be raised to own it.
  std::vector<double> thresholds(std::uint32_t group) const {
    const PowerTree tree(positions_, weights(), d_, groups_.members[group]);
    std::vector<double> result(holder_.size(), no_distance);
    for (std::size_t v = 0; v < result.size(); ++v)
      if (holder_[v] != group) result[v] = tree.least(simplices_.vertex[v]) - owner_power_[v];
    return result;
  }

  /// Computes what a group takes from each cell when raised by t, the function being taken as affine in each
  /// simplex.
  /// \return whether that is more than it needs, or than a cell can give
  bool takes_too_much(std::uint32_t group, const std::vector<double>& threshold, double t) {
    taken_.assign(mass_.size(), 0);
    double sum = 0;
    for (const CellSimplex& s : simplices_.simplex) {
      if (groups_.of[s.cell] == group || !(s.mass > 0)) continue;
      std::array<double, 4> value{};
      for (std::size_t k = 0; k < static_cast<std::size_t>(s.corners); ++k)
        value[k] = std::min(threshold[s.vertex[k]], 1e290);
      const double mass = s.mass * share_below(value, s.corners, t);
      taken_[s.cell] += mass;
      sum += mass;
    }
    if (sum > need_[group]) return true;
    for (std::size_t j = 0; j < mass_.size(); ++j) {
      // A starved cell may be swallowed: it is raised next, against a cell that has something to give.
      const double target = target_[static_cast<Eigen::Index>(j)];
      if (taken_[j] > 0 && mass_[j] >= starved_ * target &&
          mass_[j] - taken_[j] < kept * std::min(mass_[j], target))
        return true;
    }
    return false;
  }

  /// The largest amount that does not take too much, or the least that takes anything.
  double amount(std::uint32_t group, const std::vector<double>& threshold) {
    double low = no_distance, high = -no_distance;
    for (const CellSimplex& s : simplices_.simplex) {
      if (groups_.of[s.cell] == group || !(s.mass > 0)) continue;
      for (std::size_t k = 0; k < static_cast<std::size_t>(s.corners); ++k) {
        const double value = threshold[s.vertex[k]];
        low = std::min(low, value);
        if (value < no_distance) high = std::max(high, value);
      }
    }
    if (!(low < high)) return no_distance;
    const double contact = low;
    double step = (high - low) * 1e-9;
    while (low + step < high && !takes_too_much(group, threshold, low + step)) {
      low += step;
      step *= 2;
    }
    double above = std::min(low + step, high);
    for (int k = 0; k < 50; ++k) {
      const double middle = low + (above - low) / 2;
      (takes_too_much(group, threshold, middle) ? above : low) = middle;
    }
    return low > contact ? low : above;
  }

  bool raise(std::uint32_t group) {
    const std::vector<double> threshold = thresholds(group);
    const double by = amount(group, threshold);
    if (by == no_distance) return false;
    takes_too_much(group, threshold, by);
    // What earlier groups took from a cell is not known in detail: another one might take the same again.
    for (std::size_t j = 0; j < mass_.size(); ++j)
      if (taken_[j] > little * mass_[j] && touched_[j]) return false;
    for (std::size_t j = 0; j < mass_.size(); ++j) {
      if (taken_[j] > 0) touched_[j] = true;
      mass_[j] -= taken_[j];
      need_[groups_.of[j]] += taken_[j];
    }
    for (const std::uint32_t i : groups_.members[group]) weights_[i] += by;
    for (std::size_t v = 0; v < holder_.size(); ++v) {
      if (holder_[v] == group) {
        owner_power_[v] -= by;
      } else if (threshold[v] < by) {
        owner_power_[v] += threshold[v] - by;
        holder_[v] = group;
      }
    }
    return true;
  }

  const Vector& target_;
  double starved_, tolerance_;
  std::span<const double> positions_;
  std::size_t d_;
  const Groups& groups_;
  CellSimplices simplices_;
  Vector given_, weights_;
  std::vector<double> mass_, need_, owner_power_, taken_;
  std::vector<std::uint32_t> holder_;  // per vertex: the group that owns it
  std::vector<bool> touched_;          // per cell: whether a group has taken from it
};

}  // namespace

bool raise_starved(SolveContext& context, Iterate& at, const Vector& target, double starved) {
  if (context.evaluator().in_one_place() == nullptr) return false;
  const Groups groups = groups_of(at, target, starved);
  if (groups.members.size() < 2) return false;
  DiagramEvaluator& evaluator = *context.evaluator().in_one_place();
  if (evaluator.last_weights() != at.weights) at = evaluator.evaluate(at.weights);
  Raising raising(context, at, target, groups, evaluator.cells(), starved);
  if (groups.members.size() * raising.simplices() > most_work || !raising.raise_all()) return false;
  at = evaluator.evaluate(raising.raised());
  return true;
}

bool connect(SolveContext& context, Iterate& at, const Vector& target) {
  if (!raise_starved(context, at, target, starved_share)) return false;
  TransportStep step;
  step.phase = TransportPhase::ascent;
  context.record(step, at, target);
  return true;
}

}  // namespace powercell
