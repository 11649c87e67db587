#include "lib/applications/transport/cell_points.hpp"

#include <algorithm>
#include <numeric>

#include "lib/applications/transport/domain_points.hpp"
#include "lib/applications/transport/power_tree.hpp"

namespace powercell {
namespace {

/// Seeds with their images by -1, 0 and 1 periods along each axis: image k is of seed k % n.
void add_images(const Domain& domain, std::size_t d, std::vector<double>& positions,
                std::vector<double>& weights) {
  for (const std::array<double, 3>& period : domain.periods()) {
    if (period == std::array<double, 3>{}) continue;
    const std::size_t size = positions.size(), count = weights.size();
    for (const double sign : {-1.0, 1.0}) {
      for (std::size_t k = 0; k < size; ++k) positions.push_back(positions[k] + sign * period[k % d]);
      weights.insert(weights.end(), weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(count));
    }
  }
}

}  // namespace

std::vector<Weighted> cell_points(const Domain& domain, const std::vector<double>& positions,
                                  const Vector& weights, std::size_t count) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  const Weighted all = domain_points(domain, count).points;
  std::vector<double> image = positions, weight(weights.begin(), weights.end());
  if (domain.is_periodic()) add_images(domain, d, image, weight);
  std::vector<std::uint32_t> seeds(weight.size());
  std::iota(seeds.begin(), seeds.end(), 0U);
  const PowerTree tree(image, weight, d, std::move(seeds));
  const std::size_t n = positions.size() / d;
  std::vector<Weighted> cells(n);
  for (std::size_t k = 0; k < all.size(); ++k) {
    PowerTree::Point x{};
    std::copy_n(&all.positions[k * d], d, x.begin());
    const std::uint32_t owner = tree.nearest(x).seed;
    Weighted& cell = cells[owner % n];
    for (std::size_t c = 0; c < d; ++c) cell.positions.push_back(x[c] - image[owner * d + c]);
    cell.mass.push_back(all.mass[k]);
  }
  return cells;
}

}  // namespace powercell
