/// \file
/// Regular triangulations (weighted Delaunay): the dual of the power diagram of the whole space.
#pragma once

#include <powercell/device.hpp>
#include <powercell/options.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>

namespace powercell {

/// The regular triangulation of seeds in the plane (triangles) or in space (tetrahedra): rows of 3 or 4 seed
/// indices as in Dual. Decided exactly, ties broken by infinitesimal weights (docs/mathematics.md, "Certain
/// decisions"): a triangulation of the convex hull for any seeds, none of its simplices flat. Seeds that are
/// no vertex of it are hidden or duplicates. Empty where the seeds do not span the space. The cells inside a
/// box around the seeds come from the device, those that leave it from the host, which follows them as far as
/// 2^80 times the extent of the seeds: a simplex whose centre is farther out, next to the hull and flat to
/// that degree, is not found. Coordinates are taken to multiples of 2^-990 of that
/// extent, weights of 2^-910 of its square.
/// \param options  decisions are exact whatever they say
/// \throw Error as Diagram; invalid_argument where coordinates are below 1e-100 or beyond 1e100, or extend
/// over more than 8e75
POWERCELL_API Dual regular_triangulation(const Device& device, const SeedsView& seeds,
                                         const Options& options = {});

}  // namespace powercell
