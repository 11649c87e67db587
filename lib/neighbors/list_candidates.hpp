/// \file
/// Candidates from neighbour lists made on the host (kernels/neighbors/list.cl): the paper's method.
#pragma once

#include <powercell/options.hpp>

#include "lib/neighbors/candidates.hpp"
#include "lib/neighbors/flann_index.hpp"

namespace powercell {

/// How much of the lists was asked for and needed.
struct ListUse {
  std::uint64_t queries = 0;  ///< lists made, those of later rounds included
  std::uint64_t entries = 0;  ///< neighbours in them
  std::uint64_t pairs = 0;    ///< (region, seed) pairs finished
  std::uint64_t tried = 0;    ///< neighbours tried until the stopping rule held, over these pairs
  std::uint64_t cuts = 0;     ///< of those, the ones that cut something off
  std::vector<std::uint64_t> pairs_per_round;  ///< pairs finished in round r: lists doubled r times
};

class ListCandidates : public Candidates {
 public:
  /// Builds the KD-tree over the lifted seeds. \throw Error invalid_argument (options)
  ListCandidates(const Scene& scene, const Options& options);
  std::string_view file() const override { return "clip/by_list.cl"; }
  std::string_view kernel() const override { return "clip_by_list_kernel"; }
  std::size_t most_pairs(int round) const override;
  void prepare(std::span<const std::uint32_t> ranks, int round) override;
  void set_arguments(cl::Kernel& kernel, unsigned first) const override;
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override;
  int outputs() const override;
  double host_seconds() const override { return host_seconds_; }

  /// Counts how lists are used from now on. \pre no clipper has been made with this source yet
  void count_use() { counting_ = true; }
  /// What has been counted since construction.
  const ListUse& use();

 private:
  /// \param heights the lift by rank, in units of the scene's frame
  ListCandidates(const Scene& scene, const Options& options, const std::vector<double>& heights);

  std::size_t neighbors(int round) const;  ///< length of a list in this round
  void read_use();                         ///< adds what the last launch wrote

  const Scene scene_;
  std::size_t initial_;
  bool twins_;
  int threads_;
  FlannIndex index_;
  std::vector<std::uint32_t> rows_, pair_row_, distinct_;
  std::size_t count_ = 0;
  cl::RawBuffer lift_;
  cl::Buffer<std::uint32_t> neighbor_, active_list_;
  double host_seconds_ = 0;
  bool counting_ = false;
  std::size_t launched_rows_ = 0;  // of the last launch, not yet in use_
  int launched_round_ = 0;
  cl::Buffer<std::uint32_t> list_use_;  // rows x 3 (kernels/clip/by_list.cl)
  ListUse use_;
};

}  // namespace powercell
