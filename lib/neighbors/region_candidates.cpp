#include "lib/neighbors/region_candidates.hpp"

#include <numeric>

namespace powercell {

RegionCandidates::RegionCandidates(const Scene& scene, std::span<const std::uint64_t> list_offset,
                                   std::span<const std::uint32_t> list_seed, bool all_listed)
    : TreeCandidates(scene, !all_listed), list_offset_(scene.context()), list_seed_(scene.context()) {
  std::vector<std::uint64_t> offset(list_offset.begin(), list_offset.end());
  offset.resize(scene.mesh().region_count() + 1, offset.back());
  list_offset_.upload(offset);
  list_seed_.upload(list_seed);
}

void RegionCandidates::set_arguments(cl::Kernel& kernel, unsigned first) {
  kernel.args_from(first, list_offset_, list_seed_);
  TreeCandidates::set_arguments(kernel, first + 2);
}

std::unique_ptr<Candidates> RegionCandidates::for_scene(const Scene& scene) const {
  const auto seeds = static_cast<std::uint32_t>(scene.seeds().size());
  std::vector<std::uint64_t> offset{0};
  std::vector<std::uint32_t> seed(seeds * scene.mesh().region_count());
  for (std::size_t r = 0; r < scene.mesh().region_count(); ++r) {
    const auto first = seed.begin() + static_cast<std::ptrdiff_t>(offset.back());
    std::iota(first, first + seeds, 0U);
    offset.push_back(offset.back() + seeds);
  }
  return std::make_unique<RegionCandidates>(scene, offset, seed, false);
}

}  // namespace powercell
