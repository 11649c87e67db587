/// \file
/// Candidates from neighbour lists made on the host (kernels/neighbors/list.cl): the paper's method.
#pragma once

#include <mutex>
#include <powercell/options.hpp>

#include "lib/neighbors/candidates.hpp"
#include "lib/neighbors/flann_index.hpp"

namespace powercell {

/// How much of the lists was made and needed.
struct ListUse {
  std::uint64_t queries = 0;                   ///< lists made, including those of later rounds
  std::uint64_t entries = 0;                   ///< neighbours in them
  std::uint64_t pairs = 0;                     ///< (region, seed) pairs finished
  std::uint64_t tried = 0;                     ///< neighbours of these pairs tried until (8) held
  std::uint64_t cuts = 0;                      ///< those of them that cut the cell
  std::vector<std::uint64_t> pairs_per_round;  ///< pairs finished in round r, with lists doubled r times
};

class ListCandidates : public Candidates {
 public:
  /// Builds the KD-tree over the lifted seeds.
  /// \throw Error invalid_argument (options)
  ListCandidates(const Scene& scene, const Options& options);
  std::string_view file() const override { return "clip/by_list.cl"; }
  std::string_view kernel() const override { return "clip_by_list_kernel"; }
  std::size_t most_pairs(int round) const override;
  void prepare(std::span<const std::uint32_t> ranks, int round) override;
  void append_arguments(cl::Kernel& kernel) const override;
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override;
  std::unique_ptr<Candidates> on(const Scene& scene) const override;
  int outputs() const override;
  bool is_shared() const override { return false; }
  double host_seconds() const override { return host_seconds_; }

  /// Turns the counts of use() on.
  /// \pre no clipper was made with these candidates yet
  void count_use() { counting_ = true; }
  /// The counts so far.
  const ListUse& use();

 private:
  /// \param heights  the lift by rank, in units of the scene's frame
  ListCandidates(const Scene& scene, const Options& options, const std::vector<double>& heights);
  /// Searches the index of `other`, of another device.
  ListCandidates(const Scene& scene, const ListCandidates& other);

  std::size_t neighbors(int round) const;  ///< length of a list in this round
  void read_use();                         ///< adds the counts of the last launch to use_

  const Scene scene_;
  std::size_t initial_;
  bool twins_;
  int threads_;
  /// One for all devices. Each query is made with all threads, so they are made one at a time.
  struct Index {
    FlannIndex tree;
    std::mutex querying;
    Index(const SeedSet& seeds, double scale, std::span<const double> heights)
        : tree(seeds, scale, heights) {}
  };
  std::shared_ptr<Index> index_;
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
