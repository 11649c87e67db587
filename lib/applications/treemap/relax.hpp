/// \file
/// Where the seeds of a group go: to the centroids of cells of the right areas. Internal.
#pragma once

#include "lib/applications/treemap/group.hpp"

namespace powercell::treemap_detail {

/// The seeds a group starts with: those of an earlier layout where there are any, pulled into the outline,
/// the others spread evenly.
Columns starting_seeds(const Group& group);

/// Balzer and Deussen's iteration with areas solved for: Voronoi cells to their centroids twice, then,
/// `rounds` times or until seeds rest, cells of nearly the right areas to theirs, and at last the right
/// areas. In an update seeds rest already where the root mean square of their distances to the centroids, in
/// units of the cells' sizes, is below 20 %: a finished layout has 1 % in the mean, so what has changed
/// little stays where it is. Where values are steep a finished layout leaves cells far smaller than others at
/// many times their sizes from their seeds. So an update rests at once, too, where that mean, each cell
/// weighted by its area, is below 15 %: finished layouts had 12 % at worst, of values over 14 orders.
/// `Solver` has
///   void start(seeds)         new seeds with weights 0
///   bool voronoi()            their cells; false if one is empty
///   void move(seeds)          near the last ones; weights follow (docs/mathematics.md, "Transport")
///   bool solve(tolerance)     whether the areas came within it
///   bool has_lost_cells()     whether that left cells empty, which have no centroids
///   const Columns& centroid() of the last cells
/// Only rounding leaves a cell empty, in polygons far longer than thick: seeds stay where they are then.
template <class Solver>
void relax(Solver& solver, const Group& group, const GroupSettings& settings, GroupLayout& layout) {
  constexpr int voronoi_rounds = 2;
  constexpr double loose = 1e-2;
  constexpr double fresh_rest = 1e-3, update_rest = 0.2, unchanged = 0.15;
  const bool fresh = group.start.size() == 0;
  const std::size_t n = group.share.size();
  Columns& seeds = layout.seeds;
  seeds = starting_seeds(group);
  solver.start(seeds);
  for (int k = 0; k < voronoi_rounds && fresh; ++k) {
    if (!solver.voronoi()) break;
    seeds = solver.centroid();
    solver.start(seeds);
  }
  const double at_rest = fresh ? fresh_rest : update_rest;
  for (int k = 0; k < settings.rounds; ++k) {
    solver.solve(loose);
    if (solver.has_lost_cells()) break;
    const Columns& centre = solver.centroid();
    double unrest = 0, by_area = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = centre.x[i] - seeds.x[i], y = centre.y[i] - seeds.y[i];
      unrest += (x * x + y * y) / (group.share[i] * static_cast<double>(n));
      by_area += x * x + y * y;
    }
    if (unrest < at_rest * at_rest) break;
    if (!fresh && k == 0 && by_area < unchanged * unchanged) break;
    seeds = centre;
    solver.move(seeds);
  }
  layout.converged = solver.solve(settings.tolerance);
}

}  // namespace powercell::treemap_detail
