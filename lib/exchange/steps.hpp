/// \file
/// The steps of the shards that are here, in time with those elsewhere. Internal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/exchange/checks.hpp"
#include "lib/exchange/post.hpp"
#include "lib/exchange/shard.hpp"

namespace powercell::exchange {

/// What was sent, and what it took.
struct ExchangeReport {
  int rounds = 0;               ///< in which some cell was clipped
  std::uint64_t fetched = 0;    ///< seeds sent to other shards, once for each
  std::uint64_t neighbors = 0;  ///< of these, with a wall in the end
  std::uint64_t clipped = 0;    ///< cells, counted each time
  std::uint64_t vertices = 0;   ///< that other shards were asked about
  std::uint64_t outlines = 0;   ///< bytes
  std::uint64_t requests = 0;   ///< bytes
  std::uint64_t replies = 0;    ///< bytes
  std::uint64_t ending = 0;     ///< bytes of the messages about hidden seeds
};

/// Takes the steps of Shard for all shards here, one after the other.
class Steps {
 public:
  /// \param diagram  in the domain; its seeds and selection are replaced
  /// \param here     valid seeds (require_valid) of each shard that is here
  Steps(Diagram::State& diagram, std::span<const ShardSeeds> here, Post& post);

  /// \return the cells of each shard here \throw Error as Diagram
  std::vector<ShardCells> run();
  /// Of the shards here. What was sent is counted where it was sent, but requests where they are answered.
  const ExchangeReport& report() const { return report_; }

 private:
  /// Whether some shard, wherever it is, has open cells.
  bool any_open();
  void round();
  /// Tells shards which seeds that they were sent are hidden. Cells with a wall of one are opened again.
  void end_hidden();
  void mark_duplicates();
  /// Of shard `s` here to the requests of others.
  Post::Letters answers(std::size_t s, Post::Letters requests);

  Diagram::State& diagram_;
  Post& post_;
  std::vector<Shard> shards_;
  ExchangeReport report_;
};

}  // namespace powercell::exchange
