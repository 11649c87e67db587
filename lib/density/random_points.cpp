#include "lib/domain/random_points.hpp"

#include <algorithm>
#include <powercell/point_sets.hpp>
#include <random>

#include "lib/density/model.hpp"

namespace powercell {

/// Rejection: a point of the domain stays with a probability that goes with the density. The largest density
/// is that of the points seen; should a larger one come, all begins again.
std::vector<double> random_points(const Domain& domain, const Density& density, std::size_t n,
                                  std::uint64_t random_seed) {
  constexpr std::size_t batch = 4096, most_batches_a_point = 1;
  const std::unique_ptr<PointSource> source = density.model().source(domain);
  const auto d = static_cast<std::size_t>(domain.dimension());
  std::mt19937_64 engine(random_seed);
  std::vector<double> points;
  double largest = 0;
  for (std::size_t round = 0; points.size() < n * d; ++round) {
    if (round > 1000 + most_batches_a_point * n)
      throw Error(ErrorCode::invalid_argument,
                  "the density is positive in too small a part of the domain for random points: " +
                      std::to_string(points.size() / d) + " of " + std::to_string(n) + " were found");
    const std::vector<Sample> drawn = random_points(domain.mesh(), batch, engine());
    std::vector<double> value(batch);
    for (std::size_t k = 0; k < batch; ++k) {
      Point x{};
      for (std::size_t c = 0; c < 3; ++c) x[c] = static_cast<double>(drawn[k].point[c]);
      source->evaluate({&x, 1}, drawn[k].region, {&value[k], 1});
    }
    const double top = *std::max_element(value.begin(), value.end());
    if (top > largest) {
      largest = 1.2 * top;  // so that a little more does not begin it all again
      points.clear();
    }
    for (std::size_t k = 0; k < batch && points.size() < n * d; ++k) {
      const double uniform = static_cast<double>(engine() >> 11) * 0x1p-53;
      if (!(uniform * largest < value[k])) continue;
      for (std::size_t c = 0; c < d; ++c) points.push_back(static_cast<double>(drawn[k].point[c]));
    }
  }
  return points;
}

}  // namespace powercell
