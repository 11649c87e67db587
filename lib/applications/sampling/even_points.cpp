#include "lib/applications/sampling/even_points.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>

namespace powercell {
namespace {

class Halving {
 public:
  Halving(const std::vector<double>& points, std::size_t dimension) : points_(points), d_(dimension) {}

  /// Appends `wanted` of the points with these indices to `chosen`.
  void choose(std::span<std::size_t> index, std::size_t wanted, std::vector<double>& chosen) const {
    if (wanted == 1) {
      const std::size_t i = central(index);
      for (std::size_t c = 0; c < d_; ++c) chosen.push_back(points_[i * d_ + c]);
      return;
    }
    const std::size_t left = wanted / 2, count = index.size() * left / wanted, axis = longest(index);
    const auto middle = index.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(index.begin(), middle, index.end(), [&](std::size_t i, std::size_t j) {
      return std::pair{points_[i * d_ + axis], i} < std::pair{points_[j * d_ + axis], j};
    });
    choose(index.first(count), left, chosen);
    choose(index.subspan(count), wanted - left, chosen);
  }

 private:
  std::size_t longest(std::span<const std::size_t> index) const {
    std::array<double, 3> extent{};
    for (std::size_t c = 0; c < d_; ++c) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const std::size_t i : index) {
        low = std::min(low, points_[i * d_ + c]);
        high = std::max(high, points_[i * d_ + c]);
      }
      extent[c] = high - low;
    }
    return static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  }

  /// The point nearest to the mean.
  std::size_t central(std::span<const std::size_t> index) const {
    std::array<double, 3> mean{};
    for (const std::size_t i : index)
      for (std::size_t c = 0; c < d_; ++c) mean[c] += points_[i * d_ + c] / static_cast<double>(index.size());
    const auto distance = [&](std::size_t i) {
      double sum = 0;
      for (std::size_t c = 0; c < d_; ++c)
        sum += (points_[i * d_ + c] - mean[c]) * (points_[i * d_ + c] - mean[c]);
      return sum;
    };
    return *std::min_element(index.begin(), index.end(),
                             [&](std::size_t i, std::size_t j) { return distance(i) < distance(j); });
  }

  const std::vector<double>& points_;
  std::size_t d_;
};

}  // namespace

std::vector<double> even_points(const std::vector<double>& points, std::size_t dimension, std::size_t n) {
  std::vector<std::size_t> index(points.size() / dimension);
  std::iota(index.begin(), index.end(), std::size_t{0});
  std::vector<double> chosen;
  chosen.reserve(n * dimension);
  Halving(points, dimension).choose(index, n, chosen);
  return chosen;
}

}  // namespace powercell
