/// \file
/// Power diagrams whose seeds are shared out to shards, computed one shard after the other on one device.
/// Internal.
#pragma once

#include <powercell/diagram.hpp>
#include <span>
#include <vector>

#include "lib/exchange/shard.hpp"

namespace powercell::exchange {

/// The seeds of a shard; the caller owns the arrays, which must last for the call.
struct ShardSeeds {
  std::span<const std::uint64_t> ids;  ///< of the seeds, unlike all others of all shards
  SeedsView seeds;
};

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

struct ShardedDiagram {
  std::vector<ShardCells> shards;
  ExchangeReport report;
};

/// Computes the cells of all shards. Neighbours and statuses are those of one diagram of all seeds in
/// ascending order of their ids; measures and walls differ from its by rounding. Options::progress is called
/// with the fraction of what is clipped at present. \throw Error unsupported (surfaces, solids, periodic
/// domains; single precision; fast decisions;
///        Options::certify), invalid_argument (sizes, an id that is there twice), invalid_seed (names the
///        seed by its id), and as Diagram
ShardedDiagram compute_shards(const Device& device, const Domain& domain, std::span<const ShardSeeds> shards,
                              Options options = {});

}  // namespace powercell::exchange
