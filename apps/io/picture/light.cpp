#include "apps/io/picture/light.hpp"

#include <algorithm>
#include <cmath>

#include "apps/io/picture/parallel.hpp"

namespace powercell::io {
namespace {

constexpr int batch = 8;  // shadow maps in memory at once
constexpr int map_size = 512;
constexpr int sun_directions = batch;
constexpr float sun_radius = 0.025f;  // of the disc, at distance 1
constexpr float bias = 0.009f;        // distance off a surface that keeps it from shading itself
constexpr float golden_angle = 2.399963f;

// A parallel view from a direction.
class Direction {
 public:
  explicit Direction(Vec3 towards) : towards(towards) {
    right_ = normalized(cross(towards, std::abs(towards.x) < 0.7f ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    up_ = cross(towards, right_);
  }

  /// Within a disc about this direction, spread evenly (Vogel's spiral).
  Direction near(int k, int count, float radius) const {
    const float r = radius * std::sqrt((static_cast<float>(k) + 0.5f) / static_cast<float>(count));
    const float angle = golden_angle * static_cast<float>(k);
    return Direction(normalized(towards + right_ * (r * std::cos(angle)) + up_ * (r * std::sin(angle))));
  }

  Projected project(Vec3 point) const {
    constexpr float half = map_size / 2.0f;
    return {half + half * dot(point, right_), half + half * dot(point, up_), dot(point, towards)};
  }

  const Vec3 towards;

 private:
  Vec3 right_, up_;
};

// Spread evenly over the sphere (Fibonacci lattice).
Vec3 on_sphere(int k, int count) {
  const float z = 1 - (2 * static_cast<float>(k) + 1) / static_cast<float>(count);
  const float r = std::sqrt(1 - z * z), angle = golden_angle * static_cast<float>(k);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// Directions of the sun, then of the sky: fewer if there are many triangles, since each direction draws all
// of them.
std::vector<Direction> directions(Vec3 sun, std::size_t triangles) {
  std::vector<Direction> all;
  for (int k = 0; k < sun_directions; ++k) all.push_back(Direction(sun).near(k, sun_directions, sun_radius));
  const auto sky =
      static_cast<int>(std::clamp<std::size_t>(24'000'000 / (triangles + 1), 24, 64)) / batch * batch;
  for (int k = 0; k < sky; ++k) all.emplace_back(on_sphere(k, sky));
  return all;
}

bool is_lit(const Samples& map, const Projected& at) {
  if (!(at.x >= 0 && at.y >= 0 && at.x < map_size && at.y < map_size)) return true;
  return map.nearness[map.at(static_cast<int>(at.x), static_cast<int>(at.y))] <= at.nearness;
}

// Means along columns, then along rows, so that the shadows of single directions blend.
void smooth(std::vector<Light>& light, const std::vector<Place>& places, int width, bool along_rows) {
  const auto height = static_cast<int>(places.size() / static_cast<std::size_t>(width));
  const auto index = [width](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  };
  std::vector<Light> mean(light.size());
  for_each_parallel(height, [&](int row) {
    for (int column = 0; column < width; ++column) {
      const Place& here = places[index(column, row)];
      Light sum = light[index(column, row)];
      float count = 1;
      for (int k = -here.blur; k <= here.blur; ++k) {
        const int x = along_rows ? column + k : column, y = along_rows ? row : row + k;
        if (k == 0 || x < 0 || y < 0 || x >= width || y >= height) continue;
        const Place& other = places[index(x, y)];
        if (dot(other.normal, here.normal) < 0.9f ||
            std::abs(dot(other.point - here.point, here.normal)) > 0.004f)
          continue;
        sum.sun += light[index(x, y)].sun;
        sum.sky += light[index(x, y)].sky;
        ++count;
      }
      mean[index(column, row)] = {sum.sun / count, sum.sky / count};
    }
  });
  light = std::move(mean);
}

}  // namespace

std::vector<Light> light_on(const std::vector<Place>& places, int width, std::span<const Triangle> triangles,
                            Vec3 sun) {
  struct Sums {
    float sun = 0, sky = 0, whole_sky = 0;
  };
  std::vector<Sums> sums(places.size());
  const std::vector<Direction> from = directions(sun, triangles.size());
  std::vector<Samples> maps(batch, Samples(map_size, map_size));
  const auto height = static_cast<int>(places.size() / static_cast<std::size_t>(width));
  for (std::size_t first = 0; first < from.size(); first += batch) {
    for_each_parallel(batch, [&](int b) {
      const Direction& direction = from[first + static_cast<std::size_t>(b)];
      Samples& map = maps[static_cast<std::size_t>(b)];
      map.clear();
      for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto& [p, q, r] = triangles[t];
        map.draw({direction.project(p), direction.project(q), direction.project(r)}, t);
      }
    });
    for_each_parallel(height, [&](int row) {
      const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
      for (std::size_t k = begin; k < begin + static_cast<std::size_t>(width); ++k)
        for (std::size_t b = 0; b < batch; ++b) {
          const Direction& direction = from[first + b];
          const float cosine = dot(places[k].normal, direction.towards);
          if (cosine <= 0) continue;
          const bool lit = is_lit(maps[b], direction.project(places[k].point + places[k].normal * bias));
          if (first == 0) {
            sums[k].sun += lit ? 1 : 0;
          } else {
            sums[k].sky += lit ? cosine : 0;
            sums[k].whole_sky += cosine;
          }
        }
    });
  }
  std::vector<Light> light(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    if (sums[k].whole_sky > 0) light[k] = {sums[k].sun / sun_directions, sums[k].sky / sums[k].whole_sky};
  smooth(light, places, width, false);
  smooth(light, places, width, true);
  return light;
}

}  // namespace powercell::io
