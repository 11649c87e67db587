#include <flann/flann.hpp>

#include "lib/base/threads.hpp"
#include "lib/neighbors/flann_index.hpp"

namespace powercell {

struct FlannIndex::Tree {
  std::size_t dimension = 0;  // of the lifted space
  std::size_t seeds = 0;
  std::vector<double> points;  // seeds x dimension
  std::unique_ptr<flann::KDTreeSingleIndex<flann::L2_Simple<double>>> index;
};

FlannIndex::FlannIndex(const SeedSet& seeds, double scale, std::span<const double> heights)
    : tree_(std::make_unique<Tree>()) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  Tree& tree = *tree_;
  tree.dimension = d + 1;
  tree.seeds = seeds.size();
  tree.points.resize(tree.seeds * tree.dimension);
  for (std::size_t i = 0; i < tree.seeds; ++i) {
    for (std::size_t k = 0; k < d; ++k) tree.points[i * (d + 1) + k] = scale * seeds.positions[i * d + k];
    tree.points[i * (d + 1) + d] = heights[i];
  }
  const flann::Matrix<double> matrix(tree.points.data(), tree.seeds, tree.dimension);
  tree.index = std::make_unique<flann::KDTreeSingleIndex<flann::L2_Simple<double>>>(
      matrix, flann::KDTreeSingleIndexParams(12, false));
  tree.index->buildIndex();
}

FlannIndex::~FlannIndex() = default;

void FlannIndex::query(std::span<const std::uint32_t> ranks, std::size_t count, bool twins, int threads,
                       std::vector<std::uint32_t>& rows) const {
  const Tree& tree = *tree_;
  const std::size_t wanted = count + 1;  // the seed itself may be among them
  rows.resize(ranks.size() * count);
  parallel_for(threads, ranks.size(), [&](std::size_t begin, std::size_t end) {
    flann::SearchParams parameters(flann::FLANN_CHECKS_UNLIMITED);
    parameters.use_heap = wanted > 512 ? flann::FLANN_True : flann::FLANN_False;
    std::vector<double> query(tree.dimension), distance(wanted);
    std::vector<std::size_t> found(wanted);
    flann::Matrix<double> query_row(query.data(), 1, tree.dimension), distances(distance.data(), 1, wanted);
    flann::Matrix<std::size_t> indices(found.data(), 1, wanted);
    for (std::size_t q = begin; q < end; ++q) {
      const double* point = &tree.points[ranks[q] * tree.dimension];
      std::copy(point, point + tree.dimension, query.begin());
      if (twins) query.back() = -query.back();
      tree.index->knnSearch(query_row, indices, distances, wanted, parameters);
      std::uint32_t* row = rows.data() + q * count;
      std::size_t kept = 0;
      for (std::size_t k = 0; k < wanted && kept < count; ++k)
        if (found[k] != ranks[q]) row[kept++] = static_cast<std::uint32_t>(found[k]);
    }
  });
}

}  // namespace powercell
