/// \file
/// Seeds of other ranks that are neighbours of seeds here.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "lib/applications/linear/laplacian.hpp"
#include "lib/applications/transport/ranks/numbering.hpp"

namespace powercell {

/// The seeds here have the indices below their number n; those of other ranks get the next ones as they turn
/// up, and keep them.
class Beyond {
 public:
  /// All ranks call the constructor, meet() and values().
  /// \param kept       indices, among the seeds of the numbering here, of the n that take part, ascending
  /// \param positions  n x d, of these
  /// \param numbers, mailbox  kept by reference
  Beyond(const std::vector<std::uint32_t>& kept, std::span<const double> positions, std::size_t d,
         const Numbering& numbers, RankMailbox& mailbox);

  /// Makes seeds known, by their numbers, in any order and any number of times.
  void meet(std::span<const std::uint64_t> numbers);
  /// \pre the seed is here or was met
  std::uint32_t index(std::uint64_t number) const {
    return numbers_.is_here(number) ? index_here_[numbers_.index(number)] : slot_.at(number);
  }
  /// The values of the seeds elsewhere, from those that each rank has of its own.
  Vector values(const Vector& here);

  std::size_t here() const { return rows_.count(); }
  /// Number of an index in the order of all seeds that take part.
  std::uint64_t row(std::size_t index) const {
    return index < here() ? rows_.first() + index : row_[index - here()];
  }
  const Numbering& rows() const { return rows_; }
  /// By index.
  const std::vector<double>& positions() const { return positions_; }

 private:
  const Numbering& numbers_;
  RankMailbox& mailbox_;
  std::size_t d_;
  Numbering rows_;
  std::vector<std::uint32_t> index_here_;  // by seed of the numbering here
  std::vector<double> positions_;
  std::unordered_map<std::uint64_t, std::uint32_t> slot_;  // by number of a seed elsewhere: its index
  std::vector<std::uint64_t> row_;                         // by index - n
  // By rank: the indices whose values come from it, and the indices here whose values go to it.
  std::vector<std::vector<std::uint32_t>> from_, to_;
};

}  // namespace powercell
