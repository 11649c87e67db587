/// \file
/// Power diagrams whose seeds are shared out to shards, computed one shard after the other on one device.
#pragma once

#include <powercell/diagram.hpp>
#include <span>
#include <vector>

#include "lib/exchange/steps.hpp"

namespace powercell::exchange {

struct ShardedDiagram {
  std::vector<ShardCells> shards;
  ExchangeReport report;
};

/// Computes the cells of all shards. Neighbours and statuses are those of one diagram of all seeds in
/// ascending order of their ids; measures and walls differ from its by rounding. Options::progress is called
/// with the fraction of what is clipped at present.
/// \throw Error unsupported (surfaces, solids, periodic domains; single precision; fast decisions;
///        Options::certify), invalid_argument (sizes, an id that is there twice), invalid_seed (names the
///        seed by its id), and as Diagram
ShardedDiagram compute_shards(const Device& device, const Domain& domain, std::span<const ShardSeeds> shards,
                              Options options = {}, const Estimate& estimate = &Shard::boundaries);

}  // namespace powercell::exchange
