#include "lib/applications/treemap/group.hpp"

#include <cmath>

#include "lib/applications/treemap/convex_polygon.hpp"
#include "lib/applications/treemap/newton.hpp"
#include "lib/applications/treemap/relax.hpp"
#include "lib/base/positions.hpp"

namespace powercell::treemap_detail {

/// The solver of relax() for small groups, on the calling thread.
struct GroupSolver::HostSolver {
  ConvexDiagram diagram;
  LaplacianSolver laplacian;
  std::vector<double> weights;
  std::span<const double> target;
  std::uint64_t diagrams = 0, newton_steps = 0;
  bool lost_cells = false;

  void start(const Columns& seeds) {
    diagram.set_seeds(seeds, true);
    weights.assign(seeds.size(), 0);
  }
  bool voronoi() {
    ++diagrams;
    return diagram.compute(weights, {});
  }
  bool has_lost_cells() const { return lost_cells; }
  void move(const Columns& seeds) {
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const double x = seeds.x[i] - diagram.seeds().x[i], y = seeds.y[i] - diagram.seeds().y[i];
      weights[i] -= x * x + y * y;
    }
    diagram.set_seeds(seeds, true);
  }
  bool solve(double tolerance) {
    const NewtonOutcome outcome = damped_newton(diagram, laplacian, target, weights, tolerance);
    diagrams += static_cast<std::uint64_t>(outcome.diagrams);
    newton_steps += static_cast<std::uint64_t>(outcome.steps);
    lost_cells = !std::isfinite(outcome.error);
    return outcome.converged;
  }
  const Columns& centroid() const { return diagram.centroid(); }
};

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
    // The polygon has another shape now. Its centroid, the origin, is inside (unless it is a sliver).
    for (double t = 1; t > 1e-3 && !contains(group.outline, seeds.x[i], seeds.y[i]); t *= 0.9) {
      seeds.x[i] *= t;
      seeds.y[i] *= t;
    }
    if (!contains(group.outline, seeds.x[i], seeds.y[i])) {
      seeds.x[i] = fresh.x[i];
      seeds.y[i] = fresh.y[i];
    }
  }
  // Seeds at the same position would share one cell: all but the first get fresh positions.
  std::vector<double> rows;
  for (std::size_t i = 0; i < n; ++i) rows.insert(rows.end(), {seeds.x[i], seeds.y[i]});
  const std::vector<std::uint32_t> first = first_at_position(rows, 2);
  for (std::size_t i = 0; i < n; ++i) {
    if (first[i] == i) continue;
    seeds.x[i] = fresh.x[i];
    seeds.y[i] = fresh.y[i];
  }
  return seeds;
}

GroupSolver::GroupSolver() : solver_(std::make_unique<HostSolver>()) {}
GroupSolver::~GroupSolver() = default;
GroupSolver::GroupSolver(GroupSolver&&) noexcept = default;

GroupLayout GroupSolver::lay_out(const Group& group, const GroupSettings& settings) {
  GroupLayout layout;
  HostSolver& solver = *solver_;
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
