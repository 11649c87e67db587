/// \file
/// The kept edges of a surface as curves, and seeds along them.
#pragma once

#include <vector>

#include "lib/applications/remeshing/sizing.hpp"
#include "lib/applications/remeshing/surface.hpp"

namespace powercell::remeshing {

/// A polyline of kept edges from corner to corner, or a closed one.
struct Curve {
  std::vector<std::uint32_t> vertex;    ///< of the surface; if closed, the first is repeated at the end
  std::vector<std::uint32_t> triangle;  ///< per edge: an adjacent triangle
  std::vector<double> along;            ///< per vertex: length from the start
  bool closed = false;

  double length() const { return along.back(); }
  /// The point at length s from the start.
  Place at(const Surface& surface, double s) const;
};

/// Divides the kept edges into curves. They end in corners: vertices with other than two kept edges, and
/// vertices where the curve turns by more than `sharp_angle` degrees.
std::vector<Curve> kept_curves(const Surface& surface, double sharp_angle);

/// Lengths along a curve at which seeds are placed, including both ends (if closed, only the first): evenly
/// in units of h, about 1 apart.
/// \param least_edges  minimum number of chords; closed curves have at least 3
std::vector<double> seeds_along(const Sizing& sizing, const Curve& curve, std::size_t least_edges);

}  // namespace powercell::remeshing
