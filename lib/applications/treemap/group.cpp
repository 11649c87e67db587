#include "lib/applications/treemap/group.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "lib/applications/treemap/convex_polygon.hpp"
#include "lib/applications/treemap/laplacian.hpp"
#include "lib/applications/treemap/newton.hpp"
#include "lib/applications/treemap/relax.hpp"

namespace powercell::treemap_detail {
namespace {

// Diagrams, Newton's method and linear systems of small groups, all on the calling thread.
struct HostSolver {
  ConvexDiagram diagram;
  LaplacianSolver laplacian;
  std::vector<double> weights;
  std::span<const double> target;
  std::uint64_t diagrams = 0, newton_steps = 0;
  bool lost = false;

  void start(const Columns& seeds) {
    diagram.set_seeds(seeds, true);
    weights.assign(seeds.size(), 0);
  }
  bool voronoi() { return evaluate(weights, {}); }
  bool has_lost_cells() const { return lost; }
  void move(const Columns& seeds) {
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const double x = seeds.x[i] - diagram.seeds().x[i], y = seeds.y[i] - diagram.seeds().y[i];
      weights[i] -= x * x + y * y;
    }
    diagram.set_seeds(seeds, true);
  }
  bool solve(double tolerance) {
    DampedNewton newton(*this, target, weights);
    const NewtonOutcome outcome = newton.solve({tolerance});
    newton_steps += static_cast<std::uint64_t>(outcome.steps);
    lost = !std::isfinite(outcome.error);
    return outcome.converged;
  }
  const Columns& centroid() const { return diagram.centroid(); }

  // For DampedNewton.
  bool evaluate(std::span<const double> at, std::span<const double> least) {
    ++diagrams;
    return diagram.compute(at, least);
  }
  const std::vector<double>& mass() const { return diagram.mass(); }
  bool step(std::span<const double> residual, std::vector<double>& delta) {
    return laplacian.solve(diagram.walls(), residual, delta);
  }
};

// Of seeds at one place all but one go to their fresh places: together they would have one cell.
void part_equal(Columns& seeds, const Columns& fresh) {
  std::vector<std::size_t> order(seeds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) { return std::tuple(seeds.x[i], seeds.y[i], i); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  double x = std::numeric_limits<double>::quiet_NaN(), y = x;
  for (const std::size_t i : order) {
    const bool taken = seeds.x[i] == x && seeds.y[i] == y;
    x = seeds.x[i];
    y = seeds.y[i];
    if (!taken) continue;
    seeds.x[i] = fresh.x[i];
    seeds.y[i] = fresh.y[i];
  }
}

}  // namespace

Columns starting_seeds(const Group& group) {
  const std::size_t n = group.share.size();
  Columns fresh = spread_points(group.outline, n, group.random_seed);
  if (group.start.size() == 0) return fresh;
  Columns seeds = group.start;
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(seeds.x[i]) || !std::isfinite(seeds.y[i])) {
      seeds.x[i] = fresh.x[i];
      seeds.y[i] = fresh.y[i];
    }
    // The parent's polygon has another shape now; its centroid, 0, is inside (unless it is a sliver).
    for (double t = 1; t > 1e-3 && !contains(group.outline, seeds.x[i], seeds.y[i]); t *= 0.9) {
      seeds.x[i] *= t;
      seeds.y[i] *= t;
    }
    if (!contains(group.outline, seeds.x[i], seeds.y[i])) {
      seeds.x[i] = fresh.x[i];
      seeds.y[i] = fresh.y[i];
    }
  }
  part_equal(seeds, fresh);
  return seeds;
}

struct GroupSolver::Parts {
  HostSolver solver;
};

GroupSolver::GroupSolver() : parts_(std::make_unique<Parts>()) {}
GroupSolver::~GroupSolver() = default;
GroupSolver::GroupSolver(GroupSolver&&) noexcept = default;

GroupLayout GroupSolver::lay_out(const Group& group, const GroupSettings& settings) {
  GroupLayout layout;
  HostSolver& solver = parts_->solver;
  solver.diagram.set_outline(group.outline);
  solver.diagram.set_seeds({}, false);
  solver.target = group.share;
  solver.diagrams = solver.newton_steps = 0;
  relax(solver, group, settings, layout);
  solver.diagram.compute_vertices(solver.weights, layout.offset, layout.vertices);
  layout.diagrams = solver.diagrams;
  layout.newton_steps = solver.newton_steps;
  return layout;
}

}  // namespace powercell::treemap_detail
