#include "lib/base/positions.hpp"

#include <algorithm>
#include <numeric>

namespace powercell {

std::vector<std::uint32_t> first_at_position(std::span<const double> positions, std::size_t d) {
  const std::size_t n = positions.size() / d;
  std::vector<std::uint32_t> order(n), first(n);
  std::iota(order.begin(), order.end(), 0u);
  const auto at = [&](std::uint32_t i) { return positions.begin() + static_cast<std::ptrdiff_t>(i * d); };
  const auto width = static_cast<std::ptrdiff_t>(d);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const auto [p, q] = std::mismatch(at(i), at(i) + width, at(j));
    return p == at(i) + width ? i < j : *p < *q;
  });
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t i = order[k];
    const bool again = k > 0 && std::equal(at(i), at(i) + width, at(order[k - 1]));
    first[i] = again ? first[order[k - 1]] : i;
  }
  return first;
}

}  // namespace powercell
