#include "apps/io/picture/render.hpp"

#include <algorithm>
#include <cmath>

#include "apps/io/picture/light.hpp"
#include "apps/io/picture/parallel.hpp"

namespace powercell::io {
namespace {

constexpr int fine = 3;         // samples of a pixel along each axis
constexpr int strip_rows = 32;  // pixels

Vec3 linear_of(Colour colour) {
  return {static_cast<float>(to_linear(colour.red)), static_cast<float>(to_linear(colour.green)),
          static_cast<float>(to_linear(colour.blue))};
}

Samples drawn(int width, int height, const std::vector<ProjectedTriangle>& triangles) {
  Samples samples(width, height);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) samples.draw(triangles[t], t);
  return samples;
}

class Renderer {
 public:
  Renderer(const Model& model, const View& view);
  Image image() const;

 private:
  Place place(int column, int row) const;
  Vec3 normal(std::uint32_t triangle, float x, float y) const;
  bool are_divided(std::uint32_t a, std::uint32_t b) const;
  const Light& light(std::uint32_t triangle, int column, int row) const;
  Vec3 shade(std::uint32_t triangle, float x, float y, const Light& light, bool line) const;
  Vec3 floor(int column, int row, const Light& light) const;
  Samples strip(int first_row, int rows) const;
  std::vector<bool> lines(const Samples& strip) const;
  void resolve(int first_row, int rows, Image& image) const;

  const Model& model_;
  Vec3 up_, sun_;
  float ground_ = 0;  // height of the floor
  Camera camera_;
  std::vector<ProjectedTriangle> projected_;
  std::vector<Barycentric> weight_;  // of each triangle
  Samples pixels_{0, 0};             // one sample in the middle of each pixel
  std::vector<Light> light_;         // of each pixel
};

Renderer::Renderer(const Model& model, const View& view) : model_(model), up_(normalized(view.up)) {
  std::vector<Triangle> triangles;
  std::vector<Vec3> corners;
  for (const Model::Triangle& triangle : model.triangles) {
    triangles.push_back(triangle.corner);
    corners.insert(corners.end(), triangle.corner.begin(), triangle.corner.end());
  }
  for (const Vec3& corner : corners) ground_ = std::min(ground_, dot(corner, up_));
  ground_ -= 0.02f;
  camera_ = fit_camera(view, corners);
  sun_ = normalized(camera_.right * -0.45f + camera_.up * 0.62f - camera_.forward * 0.62f + up_);
  for (const auto& [a, b, c] : triangles) {
    projected_.push_back({camera_.project(a), camera_.project(b), camera_.project(c)});
    weight_.emplace_back(projected_.back());
  }
  pixels_ = drawn(camera_.width, camera_.height, projected_);
  std::vector<Place> places(pixels_.count());
  for_each_parallel(camera_.height, [&](int row) {
    for (int column = 0; column < camera_.width; ++column)
      places[pixels_.at(column, row)] = place(column, row);
  });
  light_ = light_on(places, camera_.width, triangles, sun_);
}

// The point of the model, or else of the floor, in the middle of a pixel.
Place Renderer::place(int column, int row) const {
  const float x = static_cast<float>(column) + 0.5f, y = static_cast<float>(row) + 0.5f;
  const std::size_t s = pixels_.at(column, row);
  const int size = std::max(camera_.width, camera_.height);
  if (const std::uint32_t t = pixels_.triangle[s]; t != Samples::nothing)
    return {camera_.unproject({x, y, pixels_.nearness[s]}), normal(t, x, y), size / 200};
  const Vec3 ray = camera_.ray(x, y);
  const float down = -dot(ray, up_), above = dot(camera_.eye, up_) - ground_;
  if (down < 1e-4f || above <= 0) return {};  // a camera below the floor sees none
  return {camera_.eye + ray * (above / down), up_, size / 40};
}

// Towards the camera.
Vec3 Renderer::normal(std::uint32_t triangle, float x, float y) const {
  const Barycentric& weight = weight_[triangle];
  const auto& own = model_.triangles[triangle].normal;
  const Vec3 mean = own[0] * weight(0, x, y) + own[1] * weight(1, x, y) + own[2] * weight(2, x, y);
  return normalized(dot(mean, camera_.ray(x, y)) > 0 ? mean * -1 : mean);
}

// Whether a line divides two triangles.
bool Renderer::are_divided(std::uint32_t a, std::uint32_t b) const {
  if (a == b) return false;
  if (a == Samples::nothing || b == Samples::nothing) return true;
  const Model::Triangle &one = model_.triangles[a], &other = model_.triangles[b];
  return one.part != other.part || dot(one.normal[0], other.normal[0]) < std::max(one.crease, other.crease);
}

// The light for a sample: that of its pixel, or of a neighbouring pixel, whose middle shows the same part.
const Light& Renderer::light(std::uint32_t triangle, int column, int row) const {
  const std::size_t own = pixels_.at(column, row);
  if (!are_divided(pixels_.triangle[own], triangle)) return light_[own];
  for (int y = std::max(0, row - 1); y <= std::min(camera_.height - 1, row + 1); ++y)
    for (int x = std::max(0, column - 1); x <= std::min(camera_.width - 1, column + 1); ++x)
      if (const std::size_t s = pixels_.at(x, y); !are_divided(pixels_.triangle[s], triangle))
        return light_[s];
  return light_[own];
}

Vec3 Renderer::shade(std::uint32_t triangle, float x, float y, const Light& light, bool line) const {
  const Vec3 n = normal(triangle, x, y), to_eye = normalized(camera_.ray(x, y)) * -1;
  const float height = dot(n, up_), sky = std::min(1.0f, 0.28f + 0.8f * light.sky);
  const float bright =
      0.70f * std::max(0.0f, dot(n, sun_)) * light.sun +
      sky * (0.21f * (1 + height) + 0.13f * (1 - height) + 0.16f * std::max(0.0f, dot(n, to_eye)));
  const Vec3 half = normalized(sun_ + to_eye);
  const float gloss = 0.05f * std::pow(std::max(0.0f, dot(n, half)), 40.0f) * light.sun;
  const Colour colour = model_.triangles[triangle].colour;
  return linear_of(line ? mix(colour, ink, model_.line_ink) : colour) * bright + Vec3{gloss, gloss, gloss};
}

// White, with the model's soft shadow, which fades out towards the border of the picture.
Vec3 Renderer::floor(int column, int row, const Light& light) const {
  const auto fade = [&](int at, int size) {
    const float t =
        std::min(1.0f, static_cast<float>(std::min(at, size - 1 - at)) / (0.1f * static_cast<float>(size)));
    return t * t * (3 - 2 * t);
  };
  const float shadow = 0.8f * std::max(0.0f, 0.95f - light.sky);
  const float bright = 1 - shadow * fade(column, camera_.width) * fade(row, camera_.height);
  return {bright, bright, bright};
}

// The samples of some rows of pixels, which may lie outside of the picture.
Samples Renderer::strip(int first_row, int rows) const {
  Samples strip(camera_.width * fine, rows * fine);
  const auto first = static_cast<float>(first_row), end = static_cast<float>(first_row + rows);
  for (std::uint32_t t = 0; t < projected_.size(); ++t) {
    ProjectedTriangle triangle = projected_[t];
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    if (high < first || low > end) continue;
    for (Projected& corner : triangle) corner = {corner.x * fine, (corner.y - first) * fine, corner.nearness};
    strip.draw(triangle, t);
  }
  return strip;
}

// Whether each sample lies on a line. Lines have the model's width and follow borders between samples. They
// are not drawn on surfaces far behind the nearer one.
std::vector<bool> Renderer::lines(const Samples& strip) const {
  std::vector<bool> on_line(strip.count());
  if (model_.line_width <= 0) return on_line;
  const float radius = std::max(0.0f, model_.line_width * fine / 2 - 0.5f);
  const int reach = static_cast<int>(radius);
  const auto draw_disc = [&](int column, int row, float nearness) {
    for (int y = std::max(0, row - reach); y <= std::min(strip.height - 1, row + reach); ++y)
      for (int x = std::max(0, column - reach); x <= std::min(strip.width - 1, column + reach); ++x) {
        const int dx = x - column, dy = y - row;
        if (static_cast<float>(dx * dx + dy * dy) > radius * radius) continue;
        if (strip.nearness[strip.at(x, y)] >= 0.9985f * nearness) on_line[strip.at(x, y)] = true;
      }
  };
  const auto compare = [&](int column, int row, int x, int y) {
    const std::size_t s = strip.at(column, row), t = strip.at(x, y);
    if (!are_divided(strip.triangle[s], strip.triangle[t])) return;
    const float nearness = std::max(strip.nearness[s], strip.nearness[t]);
    draw_disc(column, row, nearness);
    draw_disc(x, y, nearness);
  };
  for (int row = 0; row < strip.height; ++row)
    for (int column = 0; column < strip.width; ++column) {
      if (column + 1 < strip.width) compare(column, row, column + 1, row);
      if (row + 1 < strip.height) compare(column, row, column, row + 1);
    }
  return on_line;
}

void Renderer::resolve(int first_row, int rows, Image& image) const {
  const int margin = static_cast<int>(std::ceil(model_.line_width / 2)) + 1;  // lines from beyond reach in
  const Samples samples = strip(first_row - margin, rows + 2 * margin);
  const std::vector<bool> on_line = lines(samples);
  for (int row = first_row; row < first_row + rows; ++row)
    for (int column = 0; column < image.width; ++column) {
      Vec3 sum;
      for (int k = 0; k < fine * fine; ++k) {
        const int across = k % fine, down = k / fine;
        const std::size_t s = samples.at(column * fine + across, (row - first_row + margin) * fine + down);
        const std::uint32_t t = samples.triangle[s];
        const float x = static_cast<float>(column) + (static_cast<float>(across) + 0.5f) / fine;
        const float y = static_cast<float>(row) + (static_cast<float>(down) + 0.5f) / fine;
        const Light& here = light(t, column, row);
        sum = sum + (t == Samples::nothing ? floor(column, row, here) : shade(t, x, y, here, on_line[s]));
      }
      constexpr float share = 1.0f / (fine * fine);
      std::uint8_t* pixel = &image.rgb[3 * pixels_.at(column, row)];
      pixel[0] = to_srgb(sum.x * share);
      pixel[1] = to_srgb(sum.y * share);
      pixel[2] = to_srgb(sum.z * share);
    }
}

Image Renderer::image() const {
  Image image{camera_.width, camera_.height, {}};
  image.rgb.resize(3 * pixels_.count());
  for_each_parallel((image.height + strip_rows - 1) / strip_rows, [&](int s) {
    const int first = s * strip_rows;
    resolve(first, std::min(strip_rows, image.height - first), image);
  });
  return image;
}

}  // namespace

Image render(const Model& model, const View& view) {
  return Renderer(model, view).image();
}

}  // namespace powercell::io
