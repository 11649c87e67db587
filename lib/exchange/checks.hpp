/// \file
/// What shards are refused for, with the same error wherever they are.
#pragma once

#include <cstdint>
#include <powercell/distributed.hpp>
#include <powercell/domain.hpp>
#include <powercell/options.hpp>
#include <powercell/seeds.hpp>
#include <span>
#include <string>
#include <vector>

#include "lib/base/mailbox.hpp"
#include "lib/diagram/setup.hpp"

namespace powercell::exchange {

/// The seeds of a shard; the caller owns the arrays, which must last for the call.
struct ShardSeeds {
  std::span<const std::uint64_t> ids;  ///< of the seeds, unlike all others of all shards
  SeedsView seeds;
};

/// Where those meet who know of a seed: it depends on the id alone.
int meeting_shard(std::uint64_t id, int shards);

/// \param what  needs what is required, for the message
/// \throw Error unsupported
void require_supported(const Domain& domain, const Options& options,
                       const std::string& what = "distributed seeds");

/// \param here  the seeds of each shard that is here
/// \throw Error unsupported (single precision), invalid_argument (sizes of the seeds here, an id that is
/// there twice among all), invalid_seed (the one that a diagram of all would name, by its id)
void require_valid(const DiagramSetup& setup, std::span<const ShardSeeds> here, Mailbox& mailbox);

/// The domain and those options that decide what is computed.
std::vector<NamedValue> call_values(const Domain& domain, const Options& options);

/// \throw Error invalid_argument, with what differs
void require_same_call(const Domain& domain, const DistributedOptions& options, Mailbox& mailbox);

}  // namespace powercell::exchange
