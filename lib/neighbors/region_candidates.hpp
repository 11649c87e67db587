/// \file
/// Candidates from the seeds that can meet the region of a pair (kernels/neighbors/region.cl), and from the
/// packed tree where these are many.
#pragma once

#include "lib/neighbors/tree_candidates.hpp"

namespace powercell {

class RegionCandidates : public TreeCandidates {
 public:
  /// Uploads the lists (Pairs::list_offset, list_seed); regions beyond them have none.
  /// \param all_listed  whether every region with a pair has a list
  RegionCandidates(const Scene& scene, std::span<const std::uint64_t> list_offset,
                   std::span<const std::uint32_t> list_seed, bool all_listed);
  std::string_view file() const override { return "clip/by_region.cl"; }
  std::string_view kernel() const override { return "clip_by_region_kernel"; }
  void set_arguments(cl::Kernel& kernel, unsigned first) override;
  /// For a scene in which every seed can meet every region, and of few seeds.
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override;

 private:
  cl::Buffer<std::uint64_t> list_offset_;  ///< regions + 1; regions without a list have an empty one
  cl::Buffer<std::uint32_t> list_seed_;
};

}  // namespace powercell
