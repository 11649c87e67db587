/// \file
/// Candidates from neighbour lists made on the host (kernels/neighbors/list.cl): the paper's method.
#pragma once

#include <powercell/options.hpp>

#include "lib/clip/candidates.hpp"
#include "lib/clip/scene.hpp"
#include "lib/neighbors/flann_index.hpp"

namespace powercell {

class ListCandidates : public Candidates {
 public:
  /// Builds the KD-tree over the lifted seeds. \throw Error invalid_argument (options)
  ListCandidates(const Scene& scene, const Options& options);
  std::string_view file() const override { return "clip/by_list.cl"; }
  std::string_view kernel() const override { return "clip_by_list_kernel"; }
  std::size_t most_pairs(int round) const override;
  void prepare(std::span<const std::uint32_t> ranks, int round) override;
  void set_arguments(cl::Kernel& kernel, unsigned first) override;
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override {
    return std::make_unique<ListCandidates>(scene, Options{});
  }
  double host_seconds() const override { return host_seconds_; }

 private:
  std::size_t neighbors(int round) const;  ///< length of a list in this round

  const Scene& scene_;
  std::size_t initial_;
  bool twins_;
  int threads_;
  FlannIndex index_;
  std::vector<std::uint32_t> rows_, pair_row_, distinct_;
  std::size_t count_ = 0;
  cl::RawBuffer lift_;
  cl::Buffer<std::uint32_t> neighbor_, active_list_;
  double host_seconds_ = 0;
};

}  // namespace powercell
