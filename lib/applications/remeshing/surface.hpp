/// \file
/// The surface to be remeshed: a triangle mesh that is a manifold, with or without boundary, its neighbours
/// across edges and the edges that have to stay.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/applications/remeshing/vec.hpp"

namespace powercell::remeshing {

constexpr std::uint32_t nothing = 0xffffffffu;

struct Surface {
  std::vector<Vec> vertex;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  /// Per edge k, from corner k to corner k+1: the triangle behind it, or `nothing` at the boundary.
  std::vector<std::array<std::uint32_t, 3>> across;
  /// Per edge: it is kept, because it bounds the surface or because the triangles meet at a sharp angle.
  std::vector<std::array<bool, 3>> kept;

  std::size_t size() const { return triangle.size(); }
  Vec corner(std::uint32_t t, int k) const { return vertex[triangle[t][static_cast<std::size_t>(k)]]; }
  /// The edge of `t` that leads to triangle `other` along the edge from vertex `b` to `a` there.
  int edge_towards(std::uint32_t t, std::uint32_t a, std::uint32_t b) const;
  double area(std::uint32_t t) const { return norm(normal_of(corner(t, 0), corner(t, 1), corner(t, 2))) / 2; }
  double area() const;
  Vec normal(std::uint32_t t) const { return unit(normal_of(corner(t, 0), corner(t, 1), corner(t, 2))); }
  /// Vertices - edges + triangles; vertices that no triangle has do not count.
  int euler_characteristic() const;
};

/// A place on a surface and its sizing there.
struct Place {
  std::uint32_t triangle = nothing;
  Vec at;
};

/// Makes the surface of an input mesh. Vertices at the same position count as one; triangles are turned so
/// that neighbours agree.
/// \param vertices nv x 3   \param triangles nt x 3   \param sharp_angle degrees: edges whose triangles'
/// normals differ by more are kept
/// Needs check_triangles.
/// \throw Error invalid_domain: a triangle of no area; an edge of three or more triangles or around which the
/// surface cannot be oriented, a vertex where sheets touch
Surface make_surface(std::span<const double> vertices, std::span<const std::uint32_t> triangles,
                     double sharp_angle);

/// Fills in `across` from the triangles, whatever their orientation.
/// \throw Error invalid_domain: an edge of more than two triangles
void connect(Surface& surface);

/// The same surface with every edge longer than `longest` cut in halves until none is; `value`, a number per
/// vertex, is interpolated.
Surface refined(const Surface& surface, double longest, std::vector<double>& value);

/// At least about how many triangles come out of `refined`. Of a needle n times as long as `longest` it makes
/// n^1.58: three of half its length, again and again.
double refined_size(const Surface& surface, double longest);

/// Numbers of boundary loops.
int boundary_loops(const Surface& surface);

}  // namespace powercell::remeshing
