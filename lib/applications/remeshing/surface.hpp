/// \file
/// The surface to be remeshed: a triangle mesh that is an oriented manifold, with or without boundary, with
/// adjacency and kept edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lib/applications/remeshing/frame.hpp"

namespace powercell::remeshing {

constexpr std::uint32_t nothing = 0xffffffffu;  ///< no triangle, vertex or seed

struct Surface {
  std::vector<Vec> vertex;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  /// Per edge k, from corner k to corner k+1: the adjacent triangle, or `nothing` at the boundary.
  std::vector<std::array<std::uint32_t, 3>> across;
  /// Per edge: whether it is kept, as it is on the boundary or the triangles meet at a sharp angle.
  std::vector<std::array<bool, 3>> kept;
  Frame frame;  ///< of the positions

  std::size_t size() const { return triangle.size(); }
  Vec corner(std::uint32_t t, int k) const { return vertex[triangle[t][static_cast<std::size_t>(k)]]; }
  /// The edge of t from vertex b to vertex a, or -1: the same edge as from a to b in the adjacent triangle.
  int edge_towards(std::uint32_t t, std::uint32_t a, std::uint32_t b) const;
  double area(std::uint32_t t) const { return norm(normal_of(corner(t, 0), corner(t, 1), corner(t, 2))) / 2; }
  double area() const;
  Vec normal(std::uint32_t t) const { return unit(normal_of(corner(t, 0), corner(t, 1), corner(t, 2))); }
  /// A position in the caller's coordinates, for messages.
  std::string place_of(Vec x) const;
  /// Vertices - edges + triangles; unused vertices do not count.
  int euler_characteristic() const;
};

/// A point on a surface.
struct Place {
  std::uint32_t triangle = nothing;
  Vec at;
};

/// Makes the surface of an input mesh. Orients each component as its first triangle.
/// \pre check_triangles passed
/// \param vertices     nv x 3
/// \param triangles    nt x 3
/// \param sharp_angle  degrees; edges with a larger angle between the normals are kept
/// \param frame        to compute in
/// \throw Error invalid_domain (a triangle without area, an edge of more than two triangles, a surface that
///   cannot be oriented, a vertex where sheets touch)
Surface make_surface(std::span<const double> vertices, std::span<const std::uint32_t> triangles,
                     double sharp_angle, const Frame& frame = {});

/// Fills in `across` from the triangles, whatever their orientation.
/// \throw Error invalid_domain: an edge of more than two triangles
void connect(Surface& surface);

/// The same surface with its edges bisected until none is longer than `longest`.
/// \param value  per vertex, interpolated for new ones
Surface refined(const Surface& surface, double longest, std::vector<double>& value);

/// Estimates from below the number of triangles of refined(). A needle n times as long as `longest` becomes
/// n^1.58 triangles, as each bisection makes three of half its length.
double refined_size(const Surface& surface, double longest);

/// The number of boundary loops.
int boundary_loops(const Surface& surface);

}  // namespace powercell::remeshing
