/// \file
/// The seeds of all other pieces, which answer a piece as one other shard does.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/exchange/messages.hpp"
#include "lib/out_of_core/store.hpp"

namespace powercell::out_of_core {

/// What is known of the cells so far, by id of their seeds.
class Statuses {
 public:
  explicit Statuses(std::size_t seeds) : known_(seeds) {}
  void set(std::span<const std::uint64_t> ids, std::span<const SeedStatus> statuses) {
    for (std::size_t k = 0; k < ids.size(); ++k) known_[ids[k]] = statuses[k] == SeedStatus::hidden ? 1 : 0;
  }
  bool is_hidden(std::uint64_t id) const { return known_[id] != 0; }

 private:
  std::vector<std::uint8_t> known_;
};

/// The ids of seeds in what is sent are their ranks in the store.
class OtherSeeds {
 public:
  OtherSeeds(const Store& store, const Statuses& statuses, int threads);

  /// Answers are for a piece from here on.
  /// \param own  the tree of its seeds
  /// \return a coarse tree of the seeds of the others, finer near those of the piece
  PackedTree begin(std::size_t piece, const PackedTree& own);
  /// The seeds near the boundary of the piece, and the heaviest of all, which may reach it from anywhere.
  /// \pre none were sent since begin()
  exchange::Halo near(const exchange::BoundaryLeaves& boundary);
  exchange::Reply answer(const exchange::Request& request);
  std::uint64_t sent() const { return sent_count_; }  ///< in all

 private:
  bool is_own(std::size_t rank) const { return first_ <= rank && rank < last_; }
  void send(std::uint32_t rank, std::vector<std::uint64_t>& ids, std::vector<double>& rows);
  /// A coarse tree of all but the seeds of the piece and those of some ranks of others, ascending.
  template <class Near>
  PackedTree coarse_tree_without(const std::vector<std::uint32_t>& ranks, const Near& near) const;

  const Store& store_;
  const Statuses& statuses_;
  int threads_;
  std::size_t first_ = 0, last_ = 0;     // ranks of the piece
  std::vector<std::uint32_t> heaviest_;  // ranks, ascending
  std::vector<std::uint8_t> is_sent_;    // by rank
  std::vector<std::uint32_t> sent_;      // the ranks of these
  std::uint64_t sent_count_ = 0;
};

}  // namespace powercell::out_of_core
