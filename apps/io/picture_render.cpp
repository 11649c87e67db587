#include "apps/io/picture_render.hpp"

#include <algorithm>
#include <cmath>

#include "apps/io/picture_light.hpp"
#include "apps/io/picture_parallel.hpp"
#include "apps/io/picture_raster.hpp"

namespace powercell::io {
namespace {

constexpr int fine = 3;         // samples a pixel along each axis
constexpr int strip_rows = 32;  // pixels

float to_linear(std::uint8_t channel) {
  const float c = static_cast<float>(channel) / 255;
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

std::uint8_t to_srgb(float linear) {
  const float c = std::clamp(linear, 0.0f, 1.0f);
  const float s = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(s * 255));
}

std::array<float, 256> linear_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = to_linear(static_cast<std::uint8_t>(i));
  return table;
}

// All that one pixel's samples share.
struct Surroundings {
  float sky = 1, lit = 1;
};

struct Stage {
  const Model& model;
  Camera camera;
  Vec3 to_light;
  float floor = 0;  // height of the ground
  Shadow shadow;
  std::vector<Surroundings> pixel;  // of the whole picture
  std::array<float, 256> linear = linear_table();
};

Vec3 facing(Vec3 normal, Vec3 sight) {
  const Vec3 n = normalized(normal);
  return dot(n, sight) > 0 ? n * -1 : n;
}

Vec3 shade(const Stage& stage, Vec3 normal, Colour colour, Vec3 sight, const Surroundings& around) {
  const Vec3 n = facing(normal, sight);
  const Vec3 to_eye = normalized(sight) * -1;
  const float key = std::max(0.0f, dot(n, stage.to_light)) * around.lit;
  const float sky = (0.5f + 0.5f * n.z) * around.sky;
  const float ground = (0.5f - 0.5f * n.z) * around.sky;
  const float front = std::max(0.0f, dot(n, to_eye)) * around.sky;
  const float light = 0.70f * key + 0.42f * sky + 0.26f * ground + 0.16f * front;
  const Vec3 half = normalized(stage.to_light + to_eye);
  const float gloss = 0.05f * std::pow(std::max(0.0f, dot(n, half)), 40.0f) * around.lit;
  const Vec3 albedo{stage.linear[colour.red], stage.linear[colour.green], stage.linear[colour.blue]};
  return albedo * light + Vec3{gloss, gloss, gloss};
}

// The white floor shows only the model's soft shadow.
float floor_brightness(const Stage& stage, float x, float y) {
  const Vec3 ray = stage.camera.ray(x, y);
  if (ray.z >= -1e-4f) return 1;
  const Vec3 at = stage.camera.eye + ray * ((stage.floor - stage.camera.eye.z) / ray.z);
  const float away = length({at.x, at.y, 0});
  const float edge = std::min(
      {x, y, static_cast<float>(stage.camera.width) - x, static_cast<float>(stage.camera.height) - y});
  const float inside = std::clamp(edge / (0.06f * static_cast<float>(stage.camera.width)), 0.0f, 1.0f);
  const float strength = 0.38f * std::clamp(2.2f - away, 0.0f, 1.0f) * inside * inside * (3 - 2 * inside);
  return 1 - strength * (1 - stage.shadow.lit_below(at));
}

void light_pixels(Stage& stage) {
  const Camera& camera = stage.camera;
  Strip picture(camera.width, 0, camera.height, 1);
  const ProjectedModel projected = project(stage.model, camera);
  rasterize(picture, stage.model, projected);
  const std::vector<float> sky = open_sky(picture, camera);
  stage.pixel.resize(sky.size());
  for_each_parallel(camera.height, [&](int row) {
    for (int column = 0; column < camera.width; ++column) {
      const std::size_t s = static_cast<std::size_t>(row) * static_cast<std::size_t>(camera.width) +
                            static_cast<std::size_t>(column);
      const float x = static_cast<float>(column) + 0.5f, y = static_cast<float>(row) + 0.5f;
      stage.pixel[s].sky = sky[s];
      if (picture.inverse_depth[s] == 0) {
        stage.pixel[s].lit = floor_brightness(stage, x, y);
        continue;
      }
      const Vec3 at = camera.unproject(x, y, picture.inverse_depth[s]);
      const Vec3 normal = facing(picture.normal[s], at - camera.eye);
      const auto pattern = static_cast<unsigned>((column & 3) * 4 + (row & 3)) * 7u;
      stage.pixel[s].lit = stage.shadow.lit(at, normal, 0.012f, pattern);
    }
  });
}

void resolve(const Stage& stage, const Strip& strip, Image& image) {
  for (int row = 0; row < strip.rows; ++row) {
    for (int column = 0; column < strip.width; ++column) {
      const std::size_t pixel =
          static_cast<std::size_t>(strip.first_row + row) * static_cast<std::size_t>(strip.width) +
          static_cast<std::size_t>(column);
      const Surroundings& around = stage.pixel[pixel];
      const Vec3 sight = stage.camera.ray(static_cast<float>(column) + 0.5f,
                                          static_cast<float>(strip.first_row + row) + 0.5f);
      Vec3 sum;
      for (int k = 0; k < fine * fine; ++k) {
        const std::size_t s = static_cast<std::size_t>(row * fine + k / fine) * strip.samples_wide() +
                              static_cast<std::size_t>(column * fine + k % fine);
        const bool seen = strip.inverse_depth[s] > 0;
        sum = sum + (seen ? shade(stage, strip.normal[s], strip.colour[s], sight, around)
                          : Vec3{around.lit, around.lit, around.lit});
      }
      const float share = 1.0f / (fine * fine);
      image.rgb[3 * pixel] = to_srgb(sum.x * share);
      image.rgb[3 * pixel + 1] = to_srgb(sum.y * share);
      image.rgb[3 * pixel + 2] = to_srgb(sum.z * share);
    }
  }
}

// The corners of the model, and where the corners of its bounding box throw their shadow.
std::vector<Vec3> framed_points(const Model& model, Vec3 to_light, float floor) {
  std::vector<Vec3> points;
  for (const Model::Triangle& triangle : model.triangles) {
    for (const Vec3& corner : triangle.corner) {
      points.push_back(corner);
      points.push_back(corner - to_light * (0.7f * (corner.z - floor) / to_light.z));
    }
  }
  return points;
}

}  // namespace

Vec3 view_direction() {
  return normalized({0.60f, -0.80f, 0.52f});
}

bool faces_camera(Vec3 point, Vec3 normal) {
  return dot(view_direction() * camera_distance - point, normal) > 0;
}

Image render(const Model& model, int long_side) {
  float floor = 0;
  for (const Model::Triangle& triangle : model.triangles) {
    for (const Vec3& corner : triangle.corner) floor = std::min(floor, corner.z);
  }
  floor -= 0.02f;
  const Vec3 to_light = light_direction(fit_camera(view_direction(), {}, long_side));
  const Camera camera = fit_camera(view_direction(), framed_points(model, to_light, floor), long_side);
  Stage stage{model, camera, to_light, floor, Shadow(model, to_light), {}};
  light_pixels(stage);
  Image image{camera.width, camera.height, {}};
  image.rgb.resize(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height) * 3);
  const ProjectedModel projected = project(model, camera);
  for_each_parallel((camera.height + strip_rows - 1) / strip_rows, [&](int s) {
    const int first = s * strip_rows;
    Strip strip(camera.width, first, std::min(strip_rows, camera.height - first), fine);
    rasterize(strip, model, projected);
    resolve(stage, strip, image);
  });
  return image;
}

}  // namespace powercell::io
