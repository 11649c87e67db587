/// \file
/// Iteration of a group's seeds to the centroids of cells with the right areas.
#pragma once

#include "lib/applications/treemap/group.hpp"

namespace powercell::treemap_detail {

/// Initial seeds of a group: those of an earlier layout if there are any, moved into the outline; the others
/// evenly spread.
Columns starting_seeds(const Group& group);

/// Balzer and Deussen's iteration with exact areas: moves the seeds to the centroids of their Voronoi cells
/// twice, then to the centroids of cells with nearly the right areas until they rest, and finally solves for
/// the right areas.
///
/// An update counts as at rest sooner, so that groups that changed little stay in place: when the root mean
/// square distance from the centroids, in units of the cells' sizes, is below 20 %. (A finished layout has 1
/// % on average.) If values differ by orders of magnitude, a finished layout has tiny cells many times their
/// sizes from their seeds; so an update also rests at once when that mean, weighted by area, is below 15 %.
/// (Finished layouts have at most 12 %, with values over 14 orders of magnitude.)
///
/// `Solver` has
///   void start(seeds)          sets new seeds with weights 0
///   bool voronoi()             computes their cells; false if one is empty
///   void move(seeds)           moves the seeds by little, and the weights with them
///   bool solve(tolerance)      solves for the weights; whether the areas reached the tolerance
///   bool has_lost_cells()      whether that left cells empty, hence without centroids
///   const Columns& centroid()  of the last cells
/// Cells are lost by rounding only, in polygons much longer than thick; the seeds then stay where they are.
template <class Solver>
void relax(Solver& solver, const Group& group, const GroupSettings& settings, GroupLayout& layout) {
  constexpr int voronoi_rounds = 2;
  constexpr double loose = 1e-2;  // tolerance of the areas while seeds move
  constexpr double fresh_rest = 1e-3, update_rest = 0.2, unchanged = 0.15;  // as above
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
