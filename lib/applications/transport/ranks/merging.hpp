/// \file
/// Seeds of several ranks at the same position.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/applications/transport/ranks/numbering.hpp"

namespace powercell {

/// Which seeds here are at the position of one of a lower number, on any rank.
class Merging {
 public:
  /// All ranks call it.
  /// \param positions  n x d, finite
  /// \param numbers, mailbox kept by reference
  Merging(std::span<const double> positions, std::size_t d, const Numbering& numbers, RankMailbox& mailbox);

  /// Indices of the seeds here that are the first at their position.
  const std::vector<std::uint32_t>& kept() const { return kept_; }
  /// The masses of the seeds that were kept here, with those of the seeds merged with them. All ranks call
  /// it.
  std::vector<double> joined(std::span<const double> mass) const;
  /// Gives all seeds here the weights of those that they are merged with. All ranks call it.
  void spread(std::vector<double>& weights) const;

 private:
  const Numbering& numbers_;
  RankMailbox& mailbox_;
  std::vector<std::uint64_t> first_;  // by seed: number of the first at its position
  std::vector<std::uint32_t> kept_;
};

}  // namespace powercell
