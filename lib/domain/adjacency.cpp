#include "lib/domain/adjacency.hpp"

#include <numeric>

namespace powercell {

std::vector<std::uint32_t> weld(std::span<const double> vertices, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t count = vertices.size() / d;
  std::vector<std::uint32_t> order(count), first(count);
  std::iota(order.begin(), order.end(), 0u);
  auto position = [&](std::uint32_t v) { return vertices.subspan(v * d, d); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto pa = position(a), pb = position(b);
    for (std::size_t k = 0; k < d; ++k) {
      if (pa[k] != pb[k]) return pa[k] < pb[k];
    }
    return a < b;
  });
  for (std::size_t k = 0; k < count; ++k) {
    const bool same = k > 0 && std::ranges::equal(position(order[k]), position(order[k - 1]));
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

void number_boundary(RegionMesh& mesh) {
  for (Border& border : mesh.facet) {
    if (border.kind == Border::Kind::boundary) border.index = mesh.boundary_count++;
  }
}

}  // namespace powercell
