// Triangulation of faces: convex ones as a fan, others by cutting off ears.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <span>

#include "apps/io/read/file.hpp"
#include "apps/io/read/mesh.hpp"

namespace powercell::io {
namespace {

using Point = std::array<double, 2>;

// Ear cutting takes at least quadratic time; meshes have no faces this large.
constexpr std::size_t most_corners_of_concave_face = 4096;

double turn(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// The corners projected along the axis nearest to the face's normal (Newell's method), counter-clockwise.
// Projection along an axis does not round.
std::vector<Point> projected(const std::vector<double>& vertices, std::span<const std::uint32_t> corners) {
  const double* origin = &vertices[3 * std::size_t{corners[0]}];
  std::array<double, 3> normal{};
  const auto at = [&](std::size_t k, int axis) {
    return vertices[3 * std::size_t{corners[k % corners.size()]} + axis] - origin[axis];
  };
  for (std::size_t k = 0; k < corners.size(); ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      normal[axis] += (at(k, u) - at(k + 1, u)) * (at(k, v) + at(k + 1, v));
    }
  }
  int drop = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(normal[axis]) > std::abs(normal[drop])) drop = axis;
  }
  int u = (drop + 1) % 3, v = (drop + 2) % 3;
  if (normal[drop] < 0) std::swap(u, v);
  std::vector<Point> points(corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) points[k] = {at(k, u), at(k, v)};
  return points;
}

bool is_convex(const std::vector<Point>& points) {
  const std::size_t n = points.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (turn(points[k], points[(k + 1) % n], points[(k + 2) % n]) < 0) return false;
  }
  return true;
}

bool is_ear(const std::vector<Point>& points, const std::vector<std::uint32_t>& ring, std::size_t k) {
  const std::size_t n = ring.size();
  const Point &a = points[ring[(k + n - 1) % n]], &b = points[ring[k]], &c = points[ring[(k + 1) % n]];
  if (turn(a, b, c) <= 0) return false;
  for (std::size_t other = 0; other < n; ++other) {
    const Point& p = points[ring[other]];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

// Appends the triangles of a concave face. If no ear is left (the face crosses itself, or the rest is flat)
// the next corner is cut off anyway, since the area of such a face is not well defined.
void cut_ears(const std::vector<Point>& points, std::span<const std::uint32_t> corners,
              std::vector<std::uint32_t>& triangles) {
  std::vector<std::uint32_t> ring(corners.size());
  for (std::size_t k = 0; k < ring.size(); ++k) ring[k] = static_cast<std::uint32_t>(k);
  while (ring.size() >= 3) {
    std::size_t ear = 0;
    while (ear < ring.size() && !is_ear(points, ring, ear)) ++ear;
    if (ear == ring.size()) ear = 0;
    const std::size_t n = ring.size();
    triangles.push_back(corners[ring[(ear + n - 1) % n]]);
    triangles.push_back(corners[ring[ear]]);
    triangles.push_back(corners[ring[(ear + 1) % n]]);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
  }
}

}  // namespace

bool append_triangles(const std::vector<double>& vertices, std::span<const std::uint32_t> corners,
                      std::vector<std::uint32_t>& triangles) {
  if (corners.size() > 3) {
    const std::vector<Point> points = projected(vertices, corners);
    if (!is_convex(points)) {
      if (corners.size() > most_corners_of_concave_face) return false;
      cut_ears(points, corners, triangles);
      return true;
    }
  }
  for (std::size_t k = 2; k < corners.size(); ++k)
    triangles.insert(triangles.end(), {corners[0], corners[k - 1], corners[k]});
  return true;
}

std::vector<std::uint32_t> triangulate(const MeshFile& mesh, const std::string& name) {
  std::vector<std::uint32_t> triangles;
  triangles.reserve(mesh.face_vertex.size());
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const std::span<const std::uint32_t> corners(mesh.face_vertex.data() + mesh.face_offset[face],
                                                 mesh.face_offset[face + 1] - mesh.face_offset[face]);
    if (corners.size() < 3) {
      fail_file(name, fmt::format("face {} (from 0) has {} corners; a face needs at least 3", face,
                                  corners.size()));
    }
    if (!append_triangles(mesh.vertices, corners, triangles)) {
      fail_file(name,
                fmt::format("face {} (from 0) is concave with {} corners, more than {}; triangulate it first",
                            face, corners.size(), most_corners_of_concave_face));
    }
  }
  return triangles;
}

}  // namespace powercell::io
