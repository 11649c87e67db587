#include "lib/neighbors/hidden_seeds.hpp"

#include <algorithm>

#include "lib/base/threads.hpp"
#include "lib/neighbors/tree_candidates.hpp"
#include "lib/scene/variant.hpp"

namespace powercell {
namespace {

/// The search pays from this number of seeds on.
constexpr std::size_t least_seeds = 2048;
/// Number of leaves in a first sample, and the share of its seeds that must be hidden for a full search.
constexpr std::uint32_t sample_leaves = 256;
constexpr double least_share = 0.15;
/// Number of seeds in a sample on the host, and how many ranks on either side each is compared with.
constexpr std::size_t sample_seeds = 512, ranks_beside = 8;
/// On a surface with fewer seeds per region, the search for pairs excludes the hidden ones anyway.
constexpr std::size_t seeds_a_region = 8;

/// Whether seed a lies beyond its bisector with b: s_ab < 0 in (4).
bool is_beyond(const SeedSet& seeds, std::size_t a, std::size_t b) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  double distance2 = 0;
  for (std::size_t k = 0; k < d; ++k) {
    const double q = seeds.positions[b * d + k] - seeds.positions[a * d + k];
    distance2 += q * q;
  }
  return distance2 < seeds.weights[b] - seeds.weights[a];
}

class HiddenSearch {
 public:
  explicit HiddenSearch(const Scene& scene)
      : tree_(device_tree(scene)),
        blocks_(scene.context(), without_cells(scene), scene.buffers.blocks),
        kernel_(scene.context(),
                scene.context()->program("neighbors/hidden.cl", without_cells(scene).defines()),
                "find_hidden"),
        box_(scene.context()),
        hidden_(scene.context()) {
    const RegionMesh& mesh = scene.mesh();
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::vector<double> corners(mesh.low.begin(), mesh.low.begin() + static_cast<std::ptrdiff_t>(d));
    corners.insert(corners.end(), mesh.high.begin(), mesh.high.begin() + static_cast<std::ptrdiff_t>(d));
    const std::vector<std::byte> packed = scene.frame().pack(mesh.dimension, corners, {});
    box_.reserve(packed.size());
    box_.write(packed.data(), packed.size());
    blocks_.pack(tree_);
  }

  /// Searches the seeds of every `stride`-th leaf.
  std::vector<std::uint8_t> find(std::uint32_t stride) {
    const std::uint32_t leaves = (tree_.seed_count - 1) / PackedTree::fan + 1,
                        count = (leaves - 1) / stride + 1;
    hidden_.resize(std::size_t{count} * PackedTree::fan);
    kernel_.args(count, stride, box_);
    blocks_.append_pack_arguments(kernel_, tree_);
    kernel_.more_args(hidden_);
    kernel_.launch(count);
    return hidden_.download();
  }

 private:
  TreeBlocks::Tree tree_;
  TreeBlocks blocks_;
  cl::Kernel kernel_;
  cl::RawBuffer box_;
  cl::Buffer<std::uint8_t> hidden_;
};

}  // namespace

std::vector<std::uint8_t> hidden_seeds(const Scene& scene) {
  std::vector<std::uint8_t> hidden = HiddenSearch(scene).find(1);
  hidden.resize(scene.seeds.size());
  return hidden;
}

bool may_hide_many(const SeedSet& seeds) {
  // Of seeds of white noise that lie beyond a bisector, a quarter to a half are hidden.
  const std::size_t stride = std::max<std::size_t>(1, seeds.size() / sample_seeds);
  std::size_t tested = 0, beyond = 0;
  for (std::size_t a = ranks_beside; a + ranks_beside < seeds.size(); a += stride) {
    bool any = false;
    for (std::size_t b = a - ranks_beside; b <= a + ranks_beside; ++b) any = any || is_beyond(seeds, a, b);
    ++tested;
    beyond += any ? 1 : 0;
  }
  return static_cast<double>(beyond) > 2 * least_share * static_cast<double>(tested);
}

std::vector<std::uint8_t> hidden_seeds_if_many(const Scene& scene) {
  const SeedSet& seeds = scene.seeds;
  const RegionMesh& mesh = scene.mesh();
  const bool surface = mesh.cell_dimension < mesh.dimension;
  if (surface && seeds.size() < seeds_a_region * mesh.region_count()) return {};
  if (seeds.size() < least_seeds || !may_hide_many(seeds)) return {};
  HiddenSearch search(scene);
  const std::size_t leaves = seeds.size() / PackedTree::fan;
  const auto stride = static_cast<std::uint32_t>(std::max<std::size_t>(1, leaves / sample_leaves));
  const std::vector<std::uint8_t> sample = search.find(stride);
  const auto found = static_cast<double>(std::count(sample.begin(), sample.end(), 1));
  if (found < least_share * static_cast<double>(sample.size())) return {};
  std::vector<std::uint8_t> hidden = search.find(1);
  hidden.resize(seeds.size());
  return hidden;
}

SeedSet without_hidden(const SeedSet& seeds, const std::vector<std::uint8_t>& hidden, int threads) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  SeedSet remaining;
  remaining.dimension = seeds.dimension;
  remaining.input_count = seeds.input_count;
  remaining.duplicate = seeds.duplicate;
  std::vector<std::uint32_t> kept;
  kept.reserve(static_cast<std::size_t>(std::count(hidden.begin(), hidden.end(), 0)));
  for (std::uint32_t rank = 0; rank < seeds.size(); ++rank)
    if (!hidden[rank]) kept.push_back(rank);
  remaining.positions.resize(kept.size() * d);
  remaining.weights.resize(kept.size());
  remaining.input.resize(kept.size());
  parallel_for(threads_for(kept.size(), threads), kept.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t rank = kept[k];
      std::copy_n(&seeds.positions[rank * d], d, &remaining.positions[k * d]);
      remaining.weights[k] = seeds.weights[rank];
      remaining.input[k] = seeds.input[rank];
    }
  });
  return remaining;
}

}  // namespace powercell
