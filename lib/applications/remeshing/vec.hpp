/// \file
/// Points and directions in space, by their coordinates x, y, z and 0 by default.
#pragma once

#include <array>
#include <cmath>

namespace powercell::remeshing {

struct Vec {
  double x = 0, y = 0, z = 0;
  friend Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec operator*(Vec a, double s) { return {a.x * s, a.y * s, a.z * s}; }
  Vec& operator+=(Vec b) { return *this = *this + b; }
  friend bool operator==(Vec, Vec) = default;
};

inline double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm2(Vec a) {
  return dot(a, a);
}
inline double norm(Vec a) {
  return std::sqrt(norm2(a));
}
/// The unit vector along `a`; zero stays zero.
inline Vec unit(Vec a) {
  const double size = norm(a);
  return size > 0 ? a * (1 / size) : a;
}
/// The normal of a triangle, with the length of twice its area.
inline Vec normal_of(Vec a, Vec b, Vec c) {
  return cross(b - a, c - a);
}
/// Barycentric coordinates of a point in the plane of a triangle.
inline std::array<double, 3> barycentric(Vec p, Vec a, Vec b, Vec c) {
  const Vec n = normal_of(a, b, c);
  const double squared = norm2(n);
  if (!(squared > 0)) return {1, 0, 0};
  const double u = dot(normal_of(p, b, c), n) / squared, v = dot(normal_of(a, p, c), n) / squared;
  return {u, v, 1 - u - v};
}

}  // namespace powercell::remeshing
