/// \file
/// Convex polygons and polyhedra in long double, cut by half-spaces one at a time. For the oracles only, as
/// simple as possible, and without code shared with lib/.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <vector>

namespace powercell::test {

using Real = long double;

struct Vec {
  Real x = 0, y = 0, z = 0;
};
Vec operator+(const Vec& a, const Vec& b);
Vec operator-(const Vec& a, const Vec& b);
Vec operator*(Real s, const Vec& a);
Real dot(const Vec& a, const Vec& b);
Vec cross(const Vec& a, const Vec& b);
Real length(const Vec& a);

/// The points y with normal . y <= offset.
struct HalfSpace {
  Vec normal;
  Real offset = 0;
  Real excess(const Vec& y) const { return dot(normal, y) - offset; }  ///< positive outside
};

/// Measure, first moment and second moment about the origin.
struct Moments {
  Real measure = 0;
  Vec first;
  Real second = 0;
  Moments& operator+=(const Moments& other);
};

/// Edge k goes from vertex k to vertex k+1 (cyclic) and has the border border[k].
struct Polygon {
  std::vector<Vec> vertices;
  std::vector<Border> border;
  bool empty() const { return vertices.empty(); }
};

/// A face is a ring of vertex indices, counter-clockwise seen from outside.
struct Polyhedron {
  struct Face {
    std::vector<std::uint32_t> ring;
    Border border;
  };
  std::vector<Vec> vertices;  ///< may include vertices cut off, which are in no ring
  std::vector<Face> faces;
  bool empty() const { return faces.empty(); }
};

/// The part of the polygon or polyhedron in the half-space, including points on its plane. The edge or face
/// made by the cut gets `border`.
Polygon clip(const Polygon& polygon, const HalfSpace& half_space, Border border);
Polyhedron clip(Polyhedron polyhedron, const HalfSpace& half_space, Border border);

Moments moments(const Polygon& polygon);
Moments moments(const Polyhedron& polyhedron);
Real edge_length(const Polygon& polygon, std::size_t edge);
Vec twice_face_area(const Polyhedron& polyhedron, std::size_t face);  ///< along the outer normal
Real face_area(const Polyhedron& polyhedron, std::size_t face);

}  // namespace powercell::test
