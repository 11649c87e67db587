#include "lib/applications/remeshing/triangle.hpp"

#include <algorithm>

namespace powercell::remeshing {

// By the Voronoi regions of corners, edges and face (Ericson, Real-Time Collision Detection, section 5.1.5).
Vec nearest_in_triangle(Vec x, Vec a, Vec b, Vec c) {
  const Vec ab = b - a, ac = c - a, ax = x - a;
  const double d1 = dot(ab, ax), d2 = dot(ac, ax);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec bx = x - b;
  const double d3 = dot(ab, bx), d4 = dot(ac, bx);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const Vec cx = x - c;
  const double d5 = dot(ab, cx), d6 = dot(ac, cx);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double scale = 1 / (va + vb + vc);
  return a + ab * (vb * scale) + ac * (vc * scale);
}

double triangle_quality(Vec a, Vec b, Vec c) {
  const double u = norm(b - c), v = norm(c - a), w = norm(a - b);
  const double area = norm(normal_of(a, b, c)) / 2, half = (u + v + w) / 2;
  return half > 0 ? 6 / std::sqrt(3.0) * area / (half * std::max({u, v, w})) : 0;
}

double largest_cosine(Vec a, Vec b, Vec c) {
  const double u = norm2(b - c), v = norm2(c - a), w = norm2(a - b);
  // The least angle is opposite to the shortest edge.
  const double s = std::min({u, v, w});
  const double product = s == u ? v * w : s == v ? u * w : u * v;
  return product > 0 ? (u + v + w - 2 * s) / (2 * std::sqrt(product)) : 1;
}

double misshape(Vec a, Vec b, Vec c, double good) {
  constexpr double cosine_40 = 0.76604444311897804;
  return std::max(largest_cosine(a, b, c) / cosine_40, (1 - triangle_quality(a, b, c)) / (1 - good));
}

}  // namespace powercell::remeshing
