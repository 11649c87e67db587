/// \file
/// The edges that are kept, as curves, and seeds along them.
#pragma once

#include <vector>

#include "lib/applications/remeshing/sizing.hpp"
#include "lib/applications/remeshing/surface.hpp"

namespace powercell::remeshing {

/// A polyline of kept edges from corner to corner, or closed.
struct Curve {
  std::vector<std::uint32_t> vertex;    ///< of the surface; closed: the first is repeated at the end
  std::vector<std::uint32_t> triangle;  ///< per edge: a triangle beside it
  std::vector<double> along;            ///< length from the start, per vertex
  bool closed = false;

  double length() const { return along.back(); }
  Place at(const Surface& surface, double s) const;
};

/// Curves end in corners: vertices of other than two kept edges, and vertices where the curve turns by more
/// than `sharp_angle` degrees.
std::vector<Curve> kept_curves(const Surface& surface, double sharp_angle);

/// Lengths along a curve at which seeds stand, both ends included (closed: the first only), such that
/// neighbours are the same number of h apart, about 1. Closed curves have at least 3; open ones at least
/// `least_edges`.
std::vector<double> seeds_along(const Sizing& sizing, const Curve& curve, std::size_t least_edges);

}  // namespace powercell::remeshing
