#include "apps/io/picture/raster.hpp"

#include <algorithm>
#include <cmath>

namespace powercell::io {
namespace {

// Triangles are enlarged by this part of a sample, so that rounding leaves no gap between neighbours.
constexpr float slack = 0.01f;

// The indices in [0, size) whose samples lie between low and high.
struct Range {
  int first, end;
  Range(float low, float high, int size) : first(upwards(low, size)), end(upwards(high, size)) {}

 private:
  static int upwards(float at, int size) {
    return static_cast<int>(std::clamp(at + 0.5f, 0.0f, static_cast<float>(size)));
  }
};

}  // namespace

Barycentric::Barycentric(const ProjectedTriangle& t) {
  const float area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
  flat = !(std::abs(area) > 1e-12f);
  if (flat) return;
  const float inverse = 1 / area;
  for (std::size_t k = 0; k < 3; ++k) {
    const Projected &from = t[(k + 1) % 3], &to = t[(k + 2) % 3];
    a[k] = (from.y - to.y) * inverse;
    b[k] = (to.x - from.x) * inverse;
    c[k] = -a[k] * from.x - b[k] * from.y;
  }
}

void Samples::clear() {
  std::fill(nearness.begin(), nearness.end(), farthest);
  std::fill(triangle.begin(), triangle.end(), nothing);
}

void Samples::draw(const ProjectedTriangle& t, std::uint32_t number) {
  const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
  const auto [farthest_corner, nearest_corner] = std::minmax({t[0].nearness, t[1].nearness, t[2].nearness});
  const Range rows(low_y - slack, high_y + slack, height);
  const Range box(low_x - slack, high_x + slack, width);
  if (rows.first >= rows.end || box.first >= box.end) return;
  const Barycentric weight(t);
  if (weight.flat) return;
  std::array<float, 3> outside;  // how far a weight may be below zero
  for (std::size_t k = 0; k < 3; ++k) outside[k] = slack * (std::abs(weight.a[k]) + std::abs(weight.b[k]));
  for (int row = rows.first; row < rows.end; ++row) {
    const float y = static_cast<float>(row) + 0.5f;
    float low = low_x - slack, high = high_x + slack;  // the part of the row that the triangle covers
    for (std::size_t k = 0; k < 3; ++k) {
      const float rest = weight.b[k] * y + weight.c[k] + outside[k];
      if (weight.a[k] > 0) low = std::max(low, -rest / weight.a[k]);
      if (weight.a[k] < 0) high = std::min(high, -rest / weight.a[k]);
      if (weight.a[k] == 0 && rest < 0) high = low - 1;
    }
    const Range columns(low, high, width);
    for (int column = columns.first; column < columns.end; ++column) {
      const float x = static_cast<float>(column) + 0.5f;
      const float here = std::clamp(
          weight(0, x, y) * t[0].nearness + weight(1, x, y) * t[1].nearness + weight(2, x, y) * t[2].nearness,
          farthest_corner, nearest_corner);
      const std::size_t s = at(column, row);
      if (here <= nearness[s]) continue;
      nearness[s] = here;
      triangle[s] = number;
    }
  }
}

}  // namespace powercell::io
