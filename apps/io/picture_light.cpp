#include "apps/io/picture_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/io/picture_parallel.hpp"

namespace powercell::io {
namespace {

constexpr float far_below = -1e9f;
constexpr int taps = 16;

// Points spread evenly over the unit disc (Vogel's spiral), turned by one of 16 angles.
struct Tap {
  float x, y;
};
using Taps = std::array<Tap, taps>;

std::array<Taps, 16> make_taps() {
  std::array<Taps, 16> result{};
  for (std::size_t turn = 0; turn < result.size(); ++turn) {
    for (std::size_t k = 0; k < result[turn].size(); ++k) {
      const float radius = std::sqrt((static_cast<float>(k) + 0.5f) / taps);
      const float angle = 2.399963f * static_cast<float>(k) + 0.3926991f * static_cast<float>(turn);
      result[turn][k] = {radius * std::cos(angle), radius * std::sin(angle)};
    }
  }
  return result;
}

const Taps& disc_taps(unsigned pattern) {
  static const std::array<Taps, 16> all = make_taps();
  return all[pattern % 16];
}

float edge_height(const Vec3& a, const Vec3& b, const Vec3& c, float x, float y, float inverse_area) {
  const float u = ((c.x - b.x) * (y - b.y) - (c.y - b.y) * (x - b.x)) * inverse_area;
  const float v = ((a.x - c.x) * (y - c.y) - (a.y - c.y) * (x - c.x)) * inverse_area;
  const float w = 1 - u - v;
  return u < 0 || v < 0 || w < 0 ? far_below : u * a.z + v * b.z + w * c.z;
}

// Means over 2 radius + 1 texels along one axis of a square grid, from `from` to `to`.
void box_blur(const std::vector<float>& from, std::vector<float>& to, int size, int radius, bool along_x) {
  const auto at = [&](int line, int k) {
    const int x = along_x ? k : line, y = along_x ? line : k;
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x);
  };
  for (int line = 0; line < size; ++line) {
    float sum = 0;
    for (int k = -radius; k < size; ++k) {
      if (k + radius < size) sum += from[at(line, k + radius)];
      if (k - radius - 1 >= 0) sum -= from[at(line, k - radius - 1)];
      if (k >= 0) to[at(line, k)] = sum / static_cast<float>(2 * radius + 1);
    }
  }
}

constexpr int cover_size = 384;      // texels along the side of the blurred map
constexpr float cover_reach = 1.5f;  // model units from its middle to its side

// How much of the sky over one pixel the model around it takes (obscurance by sampled neighbours).
float obscurance(const Strip& picture, const Camera& camera, int x, int y) {
  constexpr float reach = 0.16f;
  const auto at = [&](int px, int py) {
    return static_cast<std::size_t>(py) * static_cast<std::size_t>(picture.width) +
           static_cast<std::size_t>(px);
  };
  const std::size_t s = at(x, y);
  const float inverse_depth = picture.inverse_depth[s];
  const Vec3 here =
      camera.unproject(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, inverse_depth);
  Vec3 normal = normalized(picture.normal[s]);
  if (dot(normal, here - camera.eye) > 0) normal = normal * -1;
  const float pixels = reach * camera.scale * inverse_depth;
  const auto pattern = static_cast<unsigned>((x & 3) * 4 + (y & 3)) * 7u;
  float sum = 0;
  for (const Tap& tap : disc_taps(pattern)) {
    const int px = x + static_cast<int>(std::lround(tap.x * pixels));
    const int py = y + static_cast<int>(std::lround(tap.y * pixels));
    if (px < 0 || py < 0 || px >= picture.width || py >= picture.rows) continue;
    const float other = picture.inverse_depth[at(px, py)];
    if (other == 0) continue;
    const Vec3 v =
        camera.unproject(static_cast<float>(px) + 0.5f, static_cast<float>(py) + 0.5f, other) - here;
    const float squared = dot(v, v);
    const float fade = std::max(0.0f, 1 - squared / (reach * reach));
    sum += fade * std::max(0.0f, dot(v, normal) - 0.004f) / (std::sqrt(squared) + 0.01f);
  }
  return sum / taps;
}

}  // namespace

Vec3 light_direction(const Camera& camera) {
  return normalized(camera.right * -0.45f + camera.up * 0.62f - camera.forward * 0.62f + Vec3{0, 0, 1.0f});
}

Shadow::Shadow(const Model& model, Vec3 to_light) : to_light_(to_light) {
  right_ = normalized(cross(to_light, {0.31f, 0.17f, 0.93f}));
  up_ = cross(to_light, right_);
  height_.assign(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_), far_below);
  const float half = static_cast<float>(size_) / 2;
  for (const Model::Triangle& triangle : model.triangles) {
    Vec3 p[3];
    for (int k = 0; k < 3; ++k) {
      const Vec3 corner = triangle.corner[static_cast<std::size_t>(k)];
      p[k] = {half + half * dot(corner, right_), half + half * dot(corner, up_), dot(corner, to_light_)};
    }
    const float area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    if (area == 0) continue;
    const int left = std::max(0, static_cast<int>(std::min({p[0].x, p[1].x, p[2].x})));
    const int right = std::min(size_ - 1, static_cast<int>(std::max({p[0].x, p[1].x, p[2].x})));
    const int top = std::max(0, static_cast<int>(std::min({p[0].y, p[1].y, p[2].y})));
    const int bottom = std::min(size_ - 1, static_cast<int>(std::max({p[0].y, p[1].y, p[2].y})));
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const float h = edge_height(p[0], p[1], p[2], static_cast<float>(x) + 0.5f,
                                    static_cast<float>(y) + 0.5f, 1 / area);
        float& texel = height_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) +
                               static_cast<std::size_t>(x)];
        texel = std::max(texel, h);
      }
    }
  }
  soften();
}

void Shadow::soften() {
  cover_.assign(std::size_t{cover_size} * cover_size, 0.0f);
  const float half = static_cast<float>(size_) / 2;
  for (int y = 0; y < cover_size; ++y) {
    for (int x = 0; x < cover_size; ++x) {
      const auto place = [&](int texel) {
        const float unit = (static_cast<float>(texel) + 0.5f) / (cover_size / 2) - 1;
        return half + half * cover_reach * unit;
      };
      const bool covered = nearest(place(x), place(y)) > far_below;
      cover_[static_cast<std::size_t>(y) * cover_size + static_cast<std::size_t>(x)] = covered ? 1.0f : 0.0f;
    }
  }
  std::vector<float> other(cover_.size());
  for (const int radius : {5, 9, 16}) {  // nearly a Gaussian, with a sharper core
    box_blur(cover_, other, cover_size, radius, true);
    box_blur(other, cover_, cover_size, radius, false);
  }
}

float Shadow::lit_below(Vec3 point) const {
  const auto texel = [](float at) { return (at / cover_reach + 1) * (cover_size / 2) - 0.5f; };
  const float u = texel(dot(point, right_)), v = texel(dot(point, up_));
  const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
  if (x < 0 || y < 0 || x + 1 >= cover_size || y + 1 >= cover_size) return 1;
  const float fx = u - static_cast<float>(x), fy = v - static_cast<float>(y);
  const float* row = &cover_[static_cast<std::size_t>(y) * cover_size + static_cast<std::size_t>(x)];
  const float low = row[0] + (row[1] - row[0]) * fx;
  const float high = row[cover_size] + (row[cover_size + 1] - row[cover_size]) * fx;
  return 1 - (low + (high - low) * fy);
}

float Shadow::nearest(float u, float v) const {
  const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
  if (x < 0 || y < 0 || x >= size_ || y >= size_) return far_below;
  return height_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x)];
}

float Shadow::lit(Vec3 point, Vec3 normal, float radius, unsigned pattern) const {
  const float half = static_cast<float>(size_) / 2;
  // Off the surface, so that it does not shade itself: by more where the map is wide for its slope.
  const Vec3 off = point + normal * (0.006f + 0.5f * radius);
  const float u = half + half * dot(off, right_), v = half + half * dot(off, up_);
  const float height = dot(off, to_light_) + 0.004f;
  int clear = 0;
  for (const Tap& tap : disc_taps(pattern)) {
    clear += nearest(u + tap.x * radius * half, v + tap.y * radius * half) <= height ? 1 : 0;
  }
  return static_cast<float>(clear) / taps;
}

std::vector<float> open_sky(const Strip& picture, const Camera& camera) {
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<float> raw(picture.inverse_depth.size(), 0.0f), smooth(raw.size(), 1.0f);
  for_each_parallel(picture.rows, [&](int y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::size_t s = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      if (picture.inverse_depth[s] > 0) raw[s] = obscurance(picture, camera, x, y);
    }
  });
  // Each 4 x 4 block holds all turns of the pattern; averaging over one removes the noise.
  for_each_parallel(picture.rows, [&](int y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::size_t s = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      const float depth = picture.inverse_depth[s];
      if (depth == 0) continue;
      float sum = 0, count = 0;
      for (int py = std::max(0, y - 2); py < std::min(picture.rows, y + 2); ++py) {
        for (int px = std::max(0, x - 2); px < std::min(picture.width, x + 2); ++px) {
          const std::size_t q = static_cast<std::size_t>(py) * width + static_cast<std::size_t>(px);
          if (std::abs(picture.inverse_depth[q] - depth) > 0.01f * depth) continue;
          sum += raw[q];
          count += 1;
        }
      }
      smooth[s] = std::clamp(1 - 2.2f * sum / count, 0.0f, 1.0f);
    }
  });
  return smooth;
}

}  // namespace powercell::io
