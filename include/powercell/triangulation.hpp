/// \file
/// Regular triangulations (weighted Delaunay): the dual of the power diagram of the whole space.
#pragma once

#include <powercell/device.hpp>
#include <powercell/options.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>

namespace powercell {

/// The regular triangulation of seeds in the plane (triangles) or in space (tetrahedra): rows of 3 or 4 seed
/// indices as in Dual. It triangulates the convex hull of any seeds without flat simplices: decisions are
/// exact, and infinitesimal weights break ties (docs/mathematics.md, "Certain decisions"). Seeds that are not
/// vertices of it are hidden or duplicates. Empty if the seeds do not span the space.
///
/// The device computes the cells inside a box around the seeds, the host those that leave it, as far as 2^80
/// times the extent of the seeds: a simplex whose centre lies farther out, next to the hull and flat to that
/// degree, is not found. Coordinates are rounded to multiples of 2^-990 of that extent, weights to multiples
/// of 2^-910 of its square.
/// \param options  as for Diagram; `decisions` is ignored
/// \throw Error as Diagram; invalid_argument if coordinates are below 1e-100 or above 1e100, or extend over
/// more than 8e75
POWERCELL_API Dual regular_triangulation(const Device& device, const SeedsView& seeds,
                                         const Options& options = {});

}  // namespace powercell
