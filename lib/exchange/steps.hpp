/// \file
/// The steps of the shards that are here, in time with those elsewhere.
#pragma once

#include <functional>
#include <map>
#include <powercell/distributed.hpp>
#include <span>
#include <vector>

#include "lib/base/mailbox.hpp"
#include "lib/exchange/checks.hpp"
#include "lib/exchange/shard.hpp"

namespace powercell::exchange {

using powercell::ExchangeReport;

/// The boundaries that a shard asks others with before cells are clipped, by their numbers. They decide no
/// result.
using Estimate = std::function<std::map<int, BoundaryLeaves>(const Shard&)>;

/// Takes the steps of Shard for all shards here, one after the other.
class Steps {
 public:
  /// \param diagram  in the domain; its seeds and selection are replaced
  /// \param here     valid seeds (require_valid) of each shard that is here
  Steps(Diagram::State& diagram, std::span<const ShardSeeds> here, Mailbox& mailbox,
        const Estimate& estimate = &Shard::boundaries);

  /// \return the cells of each shard here
  /// \throw Error as Diagram
  std::vector<ShardCells> run();
  /// Of the shards here. Of two shards in different places one alone counts what passes between them.
  const ExchangeReport& report() const { return report_; }

 private:
  /// Tells all shards in which box the seeds of each are.
  void share_boxes();
  /// Fetches finer coarse trees of near shards.
  void fetch_coarse_trees();
  /// Fetches the seeds that cells at the boundaries of shards need, as far as positions tell.
  void fetch_boundaries(const Estimate& estimate);
  /// Whether some shard, wherever it is, has open cells.
  bool any_open();
  void round();
  /// Tells shards which seeds that they were sent are hidden. Cells with a wall of one are opened again.
  void end_hidden();
  void mark_duplicates();
  /// Of shard `s` here to the requests of others, whose letters are emptied on the way.
  Mailbox::Letters answers(std::size_t s, Mailbox::Letters& requests);

  Diagram::State& diagram_;
  Mailbox& mailbox_;
  std::vector<Shard> shards_;
  ExchangeReport report_;
};

}  // namespace powercell::exchange
