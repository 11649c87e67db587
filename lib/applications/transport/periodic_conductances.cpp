// Conductances of walls with images.
#include <algorithm>
#include <cmath>

#include "lib/applications/transport/diagram_evaluator.hpp"

namespace powercell {
namespace {

/// |p_j + shift - p_i|.
double distance(const Domain& domain, std::span<const double> positions, std::size_t i, std::size_t j,
                const std::array<std::int32_t, 3>& shift) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  const auto periods = domain.periods();
  double squared = 0;
  for (std::size_t c = 0; c < d; ++c) {
    double by = 0;
    for (std::size_t k = 0; k < d; ++k) by += shift[k] * periods[k][c];
    const double q = positions[j * d + c] - positions[i * d + c] + by;
    squared += q * q;
  }
  return std::sqrt(squared);
}

}  // namespace

void join_images(const Domain& domain, std::span<const double> positions, Iterate& at) {
  Adjacency& walls = at.cells.walls;
  Adjacency joined;
  joined.offset = {0};
  at.conductance.clear();
  for (std::size_t i = 0; i + 1 < walls.offset.size(); ++i) {
    for (std::uint64_t begin = walls.offset[i], end = begin; begin < walls.offset[i + 1]; begin = end) {
      const std::uint32_t j = walls.neighbor[begin];
      while (end < walls.offset[i + 1] && walls.neighbor[end] == j) ++end;
      if (j == i) continue;
      // Both cells sum their walls in the same order, which is that of opposite shifts.
      double wall = 0, conductance = 0;
      for (std::uint64_t k = 0; k < end - begin; ++k) {
        const std::uint64_t here = i < j ? begin + k : end - 1 - k;
        wall += walls.wall[here];
        conductance += walls.wall[here] / (2 * distance(domain, positions, i, j, walls.shift[here]));
      }
      joined.neighbor.push_back(j);
      joined.wall.push_back(wall);
      at.conductance.push_back(conductance);
    }
    joined.offset.push_back(joined.neighbor.size());
  }
  walls = std::move(joined);
}

}  // namespace powercell
