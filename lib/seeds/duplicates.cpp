#include "lib/seeds/duplicates.hpp"

#include <algorithm>

namespace powercell {

std::vector<std::uint32_t> drop_duplicates(const SeedsView& seeds, std::vector<std::uint32_t>& order) {
  const std::size_t d = static_cast<std::size_t>(seeds.dimension);
  const auto weight = [&](std::uint32_t i) { return seeds.weights.empty() ? 0.0 : seeds.weights[i]; };
  const auto same_position = [&](std::uint32_t i, std::uint32_t j) {
    const double* p = &seeds.positions[i * d];
    const double* q = &seeds.positions[j * d];
    return std::equal(p, p + d, q);
  };
  std::vector<std::uint32_t> dropped;
  std::size_t kept = 0;
  for (const std::uint32_t i : order) {
    if (kept == 0 || !same_position(order[kept - 1], i)) {
      order[kept++] = i;
      continue;
    }
    std::uint32_t& winner = order[kept - 1];
    const bool better = weight(i) > weight(winner) || (weight(i) == weight(winner) && i < winner);
    dropped.push_back(better ? winner : i);
    if (better) winner = i;
  }
  order.resize(kept);
  std::sort(dropped.begin(), dropped.end());
  return dropped;
}

}  // namespace powercell
