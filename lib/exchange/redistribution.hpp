/// \file
/// Seeds sent to other ranks, and the results sent back.
#pragma once

#include <cstdint>
#include <powercell/distributed.hpp>
#include <vector>

#include "lib/base/mailbox.hpp"
#include "lib/domain/period.hpp"
#include "lib/exchange/checks.hpp"

namespace powercell::exchange {

/// Ranges of a Hilbert curve through the seeds of all ranks, about as many seeds in each.
class Redistribution {
 public:
  /// Sends the seeds.
  /// \param own  of this rank, valid
  /// \param mailbox  with one shard a rank
  /// \param period  of the domain that the curve goes through, null if it is not periodic
  Redistribution(const ShardSeeds& own, int dimension, int threads, Mailbox& mailbox,
                 const Period* period = nullptr);

  /// The seeds to compute on this rank; valid as long as this.
  ShardSeeds seeds() const { return {ids_, {dimension_, positions_, weights_}}; }
  /// \param cells  of seeds()
  /// \return those of the seeds that were given
  DistributedCells send_back(const DistributedCells& cells);
  /// Sent by this rank so far.
  std::uint64_t bytes() const { return bytes_; }

 private:
  Mailbox::Letters deliver(Mailbox::Letters letters);
  /// The ranks that the seeds go to.
  std::vector<std::size_t> destinations(const ShardSeeds& own, int threads, const Period* period);

  int dimension_;
  Mailbox& mailbox_;
  std::vector<std::vector<std::size_t>> given_;  // by rank that they went to: indices of the seeds given
  std::vector<std::size_t> received_;            // by rank that they came from: the number of seeds here
  std::vector<std::uint64_t> ids_;
  std::vector<double> positions_, weights_;
  std::uint64_t bytes_ = 0;
};

}  // namespace powercell::exchange
