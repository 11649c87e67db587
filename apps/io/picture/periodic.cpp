#include "apps/io/picture/periodic.hpp"

#include <cmath>

namespace powercell::io {
namespace {

constexpr double margin_of_picture = 0.03;  ///< more than its part of the longer side

/// The first and last whole factor of a period, whose coordinate is `normal` . x.
std::array<long, 2> factors(const Translation& normal, const Translation& middle, const Translation& half) {
  const double at = normal[0] * middle[0] + normal[1] * middle[1];
  const double reach = std::abs(normal[0]) * half[0] + std::abs(normal[1]) * half[1];
  return {std::lround(std::ceil(at - reach - 1e-9)), std::lround(std::floor(at + reach + 1e-9))};
}

}  // namespace

std::vector<Translation> translations_into_view(const Domain& domain, const FlatBox& box) {
  if (!domain.is_periodic()) return {{0, 0}};
  const auto periods = domain.periods();
  const Translation a{periods[0][0], periods[0][1]}, b{periods[1][0], periods[1][1]};
  const std::array<double, 3> low = domain.low(), high = domain.high();
  const double margin = margin_of_picture * std::max(high[0] - low[0], high[1] - low[1]);
  Translation middle{}, half{};
  for (std::size_t k = 0; k < 2; ++k) {
    middle[k] = (low[k] + high[k]) / 2 - (box.low[k] + box.high[k]) / 2;
    half[k] = (high[k] - low[k]) / 2 + margin + (box.high[k] - box.low[k]) / 2;
  }
  const double area = a[0] * b[1] - a[1] * b[0];
  std::array<long, 2> of_a{0, 0}, of_b{0, 0};
  if (area != 0) {
    of_a = factors({b[1] / area, -b[0] / area}, middle, half);
    of_b = factors({-a[1] / area, a[0] / area}, middle, half);
  } else if (a[0] != 0) {
    of_a = factors({1 / a[0], 0}, middle, half);
  } else {
    of_b = factors({0, 1 / b[1]}, middle, half);
  }
  std::vector<Translation> found;
  for (long i = of_a[0]; i <= of_a[1]; ++i)
    for (long j = of_b[0]; j <= of_b[1]; ++j) {
      const Translation by{static_cast<double>(i) * a[0] + static_cast<double>(j) * b[0],
                           static_cast<double>(i) * a[1] + static_cast<double>(j) * b[1]};
      bool overlaps = true;
      for (std::size_t k = 0; k < 2; ++k)
        overlaps =
            overlaps && box.low[k] + by[k] <= high[k] + margin && box.high[k] + by[k] >= low[k] - margin;
      if (overlaps) found.push_back(by);
    }
  return found;
}

}  // namespace powercell::io
