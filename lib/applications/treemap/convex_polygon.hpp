/// \file
/// Convex polygons in the plane: moments, validation, containment, coordinates.
#pragma once

#include <cstdint>
#include <powercell/domain.hpp>
#include <span>

#include "lib/applications/treemap/convex_diagram.hpp"

namespace powercell::treemap_detail {

/// Area, centroid, and the second moments about the centroid (integrals of x², xy and y²).
struct PolygonMoments {
  double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};
/// \param vertices  x, y pairs, counter-clockwise; all 0 for fewer than three
PolygonMoments moments(std::span<const double> vertices);

/// The ratio of the longer to the shorter principal axis of a convex polygon with an area: 1 for a square and
/// a regular hexagon. Above 10^7 accurate to a tenth only, unless the axes are those of x and y.
double aspect(const PolygonMoments& moments);

/// The outline as x, y pairs, counter-clockwise, without repeated and collinear points.
/// \throw Error invalid_domain if it is not convex (where), crosses itself, has no area, or an area that
///   rounding may change by a millionth
std::vector<double> convex_outline(const Ring& ring);

/// The coordinates of a group, in which its polygon has the area 1 and its centroid at the origin.
struct GroupFrame {
  double x, y, size;
  explicit GroupFrame(const PolygonMoments& of);
  Columns inside(std::span<const double> vertices) const;
  double outside_x(double local) const { return x + size * local; }
  double outside_y(double local) const { return y + size * local; }
};

/// Whether the point is inside by more than rounding errors.
bool contains(const Columns& polygon, double x, double y);

/// n points evenly spread in a convex polygon with its centroid at the origin: Roberts's sequence with a
/// random start.
Columns spread_points(const Columns& polygon, std::size_t n, std::uint64_t random_seed);

}  // namespace powercell::treemap_detail
