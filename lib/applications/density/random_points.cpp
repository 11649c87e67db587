#include <algorithm>
#include <array>
#include <optional>
#include <powercell/point_sets.hpp>
#include <powercell/regions.hpp>
#include <random>

#include "lib/applications/density/parts.hpp"
#include "lib/base/float_environment.hpp"
#include "lib/base/random.hpp"

namespace powercell {
namespace {

// The largest density is estimated from points; this factor above it, a slightly larger one later on does not
// start the sampling over.
constexpr double headroom = 1.2;

/// Rejection sampling: keeps a uniform point of the domain with a probability proportional to the density
/// there. Starts over whenever the density exceeds its estimated largest value.
/// \return nullopt if too few points are kept
std::optional<std::vector<double>> points_by_rejection(const Domain& domain, const Density& density,
                                                       std::size_t n, std::uint64_t random_seed) {
  constexpr std::size_t batch = 4096, batches_at_least = 64, most_draws_a_point = 4096;
  const std::unique_ptr<PointSource> source = density.model().source(domain);
  const auto d = static_cast<std::size_t>(domain.dimension());
  std::mt19937_64 engine(random_seed);
  std::vector<double> points;
  double largest = 0;
  std::size_t draws = 0;  // since the last start
  for (std::size_t round = 0; points.size() < n * d; ++round) {
    if (round >= batches_at_least && points.size() / d * most_draws_a_point < draws) return std::nullopt;
    const std::vector<RegionPoint> drawn = random_points(domain, batch, engine());
    std::vector<double> value(batch);
    for (std::size_t k = 0; k < batch; ++k) {
      source->evaluate({&drawn[k].point, 1}, drawn[k].region, {&value[k], 1});
    }
    const double top = *std::max_element(value.begin(), value.end());
    if (top > largest) {
      largest = headroom * top;
      points.clear();
      draws = 0;
    }
    draws += batch;
    for (std::size_t k = 0; k < batch && points.size() < n * d; ++k) {
      if (!(uniform(engine) * largest < value[k])) continue;
      for (std::size_t c = 0; c < d; ++c) points.push_back(drawn[k].point[c]);
    }
  }
  return points;
}

Point point_in(const Part& part, std::mt19937_64& engine) {
  const std::array<long double, 4> share = uniform_barycentric(part.corners, engine);
  Point x{};
  for (std::size_t c = 0; c < part.corners; ++c)
    for (std::size_t k = 0; k < 3; ++k) x[k] += static_cast<double>(share[c]) * part.corner[c][k];
  return x;
}

/// n points of a part by rejection. Starts over whenever the density exceeds its estimated largest value.
std::vector<Point> points_in(const Part& part, std::size_t n, PointSource& source, std::mt19937_64& engine) {
  constexpr std::size_t most_draws = 1000000;
  std::vector<Point> points;
  double largest = headroom * part.most;
  for (std::size_t draws = 0; points.size() < n; ++draws) {
    if (draws > most_draws * (points.size() + 1))
      refuse_too_small_a_part("no point was kept of " + std::to_string(draws) + " in a part of it");
    const Point x = point_in(part, engine);
    double value = 0;
    source.evaluate({&x, 1}, part.region, {&value, 1});
    if (value > largest) {
      largest = headroom * value;
      points.clear();
    }
    if (uniform(engine) * largest < value) points.push_back(x);
  }
  return points;
}

/// Draws parts of the domain by their masses, then points in each.
std::vector<double> points_by_parts(const Domain& domain, const Density& density, std::size_t n,
                                    std::uint64_t random_seed) {
  const std::vector<Part> parts = parts_by_density(domain, density.model());
  const std::unique_ptr<PointSource> source = density.model().source(domain);
  std::vector<double> up_to;
  double sum = 0;
  for (const Part& part : parts) up_to.push_back(sum += part.mass);
  std::mt19937_64 engine(random_seed);
  std::vector<std::vector<std::size_t>> drawn(parts.size());
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = std::upper_bound(up_to.begin(), up_to.end() - 1, uniform(engine) * sum);
    drawn[static_cast<std::size_t>(at - up_to.begin())].push_back(i);
  }
  const auto d = static_cast<std::size_t>(domain.dimension());
  std::vector<double> result(n * d);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::vector<Point> points = points_in(parts[p], drawn[p].size(), *source, engine);
    for (std::size_t k = 0; k < points.size(); ++k)
      std::copy_n(points[k].begin(), d, &result[drawn[p][k] * d]);
  }
  return result;
}

}  // namespace

std::vector<double> random_points(const Domain& domain, const Density& density, std::size_t n,
                                  std::uint64_t random_seed) {
  const FloatEnvironment environment;
  if (auto points = points_by_rejection(domain, density, n, random_seed)) return std::move(*points);
  return points_by_parts(domain, density, n, random_seed);
}

}  // namespace powercell
