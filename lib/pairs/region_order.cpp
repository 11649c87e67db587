#include "lib/pairs/region_order.hpp"

#include "lib/seeds/hilbert.hpp"
#include "lib/seeds/threads.hpp"

namespace powercell::pairs {

std::vector<std::uint32_t> region_order(const RegionMesh& mesh, int threads) {
  const std::size_t d = static_cast<std::size_t>(mesh.dimension);
  std::vector<double> centroids(mesh.region_count() * d);
  parallel_for(threads, mesh.region_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const std::uint32_t first = mesh.region_offset[r], last = mesh.region_offset[r + 1];
      for (std::uint32_t slot = first; slot < last; ++slot)
        for (std::size_t k = 0; k < d; ++k)
          centroids[r * d + k] += mesh.vertices[mesh.region_vertex[slot] * d + k] / (last - first);
    }
  });
  return hilbert_order(centroids, mesh.dimension, threads);
}

}  // namespace powercell::pairs
