#include "apps/io/picture_raster.hpp"

#include <algorithm>
#include <cmath>

namespace powercell::io {
namespace {

// The samples of a strip that a box of pixels covers.
struct Window {
  int left, right, top, bottom;  // inclusive
  bool empty() const { return left > right || top > bottom; }
};

Window window(const Strip& strip, float low_x, float high_x, float low_y, float high_y) {
  const auto fine = static_cast<float>(strip.fine);
  const auto clamped = [](float at, int end) {
    return static_cast<int>(std::clamp(at, -1.0f, static_cast<float>(end)));
  };
  const int wide = strip.width * strip.fine, high = strip.rows * strip.fine;
  const auto row = static_cast<float>(strip.first_row);
  return {std::max(0, clamped(std::floor(low_x * fine - 0.5f), wide)),
          std::min(wide - 1, clamped(std::ceil(high_x * fine - 0.5f), wide)),
          std::max(0, clamped(std::floor((low_y - row) * fine - 0.5f), high)),
          std::min(high - 1, clamped(std::ceil((high_y - row) * fine - 0.5f), high))};
}

// Position of a sample's middle in pixels.
float sample_x(const Strip& strip, int column) {
  return (static_cast<float>(column) + 0.5f) / static_cast<float>(strip.fine);
}
float sample_y(const Strip& strip, int row) {
  return static_cast<float>(strip.first_row) +
         (static_cast<float>(row) + 0.5f) / static_cast<float>(strip.fine);
}

// The part of a row in which a x + b >= 0, as [low, high].
struct Span {
  float low, high;
  void keep_where_positive(float a, float b) {
    if (a > 0) low = std::max(low, -b / a);
    if (a < 0) high = std::min(high, -b / a);
    if (a == 0 && b < 0) high = low - 1;
  }
  // First and last column with its middle inside.
  int first(const Strip& strip, int left) const {
    const float column = low * static_cast<float>(strip.fine) - 0.5f;
    return std::max(left, static_cast<int>(std::ceil(std::max(column, -1.0f))));
  }
  int last(const Strip& strip, int right) const {
    const float column = high * static_cast<float>(strip.fine) - 0.5f;
    return std::min(right, static_cast<int>(std::floor(std::min(column, static_cast<float>(right)))));
  }
};

// A function a x + b y + c that is 1 at one corner of a triangle and 0 along the opposite side.
struct Share {
  float a, b, c;
  Share(const Projected& from, const Projected& to, float inverse_area)
      : a(-(to.y - from.y) * inverse_area), b((to.x - from.x) * inverse_area), c(-a * from.x - b * from.y) {}
};

void draw_triangle(Strip& strip, const Model::Triangle& triangle, const ProjectedModel::Corner& corner,
                   bool front_only) {
  const auto& [a, b, c] = corner.at;
  const Window box = window(strip, std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}),
                            std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}));
  const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (box.empty() || area == 0 || (front_only && area > 0)) return;  // y runs down: fronts run clockwise
  const Share u(b, c, 1 / area), v(c, a, 1 / area);
  for (int row = box.top; row <= box.bottom; ++row) {
    const float y = sample_y(strip, row);
    const float u0 = u.b * y + u.c, v0 = v.b * y + v.c;
    Span span{sample_x(strip, box.left), sample_x(strip, box.right)};
    span.keep_where_positive(u.a, u0);
    span.keep_where_positive(v.a, v0);
    span.keep_where_positive(-u.a - v.a, 1 - u0 - v0);
    const int last = span.last(strip, box.right);
    for (int column = span.first(strip, box.left); column <= last; ++column) {
      const float x = sample_x(strip, column);
      const float share_a = u.a * x + u0, share_b = v.a * x + v0, share_c = 1 - share_a - share_b;
      const float inverse_depth =
          share_a * a.inverse_depth + share_b * b.inverse_depth + share_c * c.inverse_depth;
      const std::size_t s =
          static_cast<std::size_t>(row) * strip.samples_wide() + static_cast<std::size_t>(column);
      if (inverse_depth <= strip.inverse_depth[s]) continue;
      strip.inverse_depth[s] = inverse_depth;
      strip.normal[s] =
          triangle.normal[0] * share_a + triangle.normal[1] * share_b + triangle.normal[2] * share_c;
      strip.colour[s] = triangle.colour;
    }
  }
}

// How far apart in depth a surface and a line drawn on it may lie at a sample half a line's width off
// the line: more where the surface is seen at a grazing angle.
float depth_allowance(const Strip& strip, std::size_t sample, const Camera& camera, float x, float y,
                      float half_width) {
  const Vec3 sight = normalized(camera.ray(x, y));
  const Vec3 normal = normalized(strip.normal[sample]);
  const float cosine = std::max(0.12f, std::abs(dot(sight, normal)));
  const float slope = std::sqrt(1 - std::min(1.0f, cosine * cosine)) / cosine;
  return 0.0006f + slope * (half_width + 1) / camera.scale;  // relative to the depth
}

// A line is drawn onto the surface it lies on: it changes only colours, and only where its depth is
// that of the surface within a small allowance.
void draw_line(Strip& strip, const Model::Line& line, Projected from, Projected to, const Camera& camera) {
  const float half = line.width / 2;
  const Window box = window(strip, std::min(from.x, to.x) - half, std::max(from.x, to.x) + half,
                            std::min(from.y, to.y) - half, std::max(from.y, to.y) + half);
  const float dx = to.x - from.x, dy = to.y - from.y;
  const float squared = dx * dx + dy * dy, reach = half * std::sqrt(squared);
  for (int row = box.top; row <= box.bottom; ++row) {
    const float y = sample_y(strip, row) - from.y;
    Span span{sample_x(strip, box.left), sample_x(strip, box.right)};
    span.keep_where_positive(-dy, reach + y * dx + dy * from.x);  // |(x - from) cross d| <= reach
    span.keep_where_positive(dy, reach - y * dx - dy * from.x);
    const int last = span.last(strip, box.right);
    for (int column = span.first(strip, box.left); column <= last; ++column) {
      const float x = sample_x(strip, column) - from.x;
      const float t = squared > 0 ? std::clamp((x * dx + y * dy) / squared, 0.0f, 1.0f) : 0.0f;
      const float off_x = x - t * dx, off_y = y - t * dy;
      if (off_x * off_x + off_y * off_y > half * half) continue;
      const float inverse_depth = from.inverse_depth + t * (to.inverse_depth - from.inverse_depth);
      const std::size_t s =
          static_cast<std::size_t>(row) * strip.samples_wide() + static_cast<std::size_t>(column);
      const float surface = strip.inverse_depth[s];
      if (surface == 0) continue;
      const float apart = std::abs(inverse_depth - surface) / surface;
      if (apart > depth_allowance(strip, s, camera, x + from.x, y + from.y, half)) continue;
      strip.colour[s] = line.colour;
    }
  }
}

}  // namespace

ProjectedModel project(const Model& model, const Camera& camera) {
  ProjectedModel projected;
  projected.camera = camera;
  projected.triangles.resize(model.triangles.size());
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      projected.triangles[t].at[k] = camera.project(model.triangles[t].corner[k]);
    }
  }
  projected.lines.reserve(2 * model.lines.size());
  for (const Model::Line& line : model.lines) {
    projected.lines.push_back(camera.project(line.from));
    projected.lines.push_back(camera.project(line.to));
  }
  return projected;
}

Strip::Strip(int width, int first_row, int rows, int fine)
    : width(width), first_row(first_row), rows(rows), fine(fine) {
  const std::size_t samples = samples_wide() * static_cast<std::size_t>(rows * fine);
  inverse_depth.assign(samples, 0.0f);
  normal.resize(samples);
  colour.resize(samples);
}

void rasterize(Strip& strip, const Model& model, const ProjectedModel& projected) {
  const auto low = static_cast<float>(strip.first_row);
  const auto high = static_cast<float>(strip.first_row + strip.rows);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const auto& [a, b, c] = projected.triangles[t].at;
    if (std::max({a.y, b.y, c.y}) < low || std::min({a.y, b.y, c.y}) > high) continue;
    draw_triangle(strip, model.triangles[t], projected.triangles[t], model.closed);
  }
  for (std::size_t l = 0; l < model.lines.size(); ++l) {
    const Projected &from = projected.lines[2 * l], &to = projected.lines[2 * l + 1];
    const float half = model.lines[l].width / 2;
    if (std::max(from.y, to.y) + half < low || std::min(from.y, to.y) - half > high) continue;
    draw_line(strip, model.lines[l], from, to, projected.camera);
  }
}

}  // namespace powercell::io
