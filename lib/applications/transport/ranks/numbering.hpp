/// \file
/// The numbers of seeds on ranks, those of rank 0 first.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lib/base/rank_mailbox.hpp"

namespace powercell {

class Numbering {
 public:
  /// \param count  of the seeds here
  Numbering(RankMailbox& mailbox, std::uint64_t count)
      : rank_(static_cast<std::size_t>(mailbox.first())), begin_{0} {
    std::vector<std::uint64_t> of_rank;
    for (const Bytes& bytes : mailbox.share({packed(std::vector{count})})) {
      unpack(bytes, of_rank);
      begin_.push_back(begin_.back() + of_rank.at(0));
    }
  }

  std::uint64_t first() const { return begin_[rank_]; }  ///< number of the first seed here
  std::uint64_t total() const { return begin_.back(); }
  std::size_t count() const { return begin_[rank_ + 1] - begin_[rank_]; }
  int owner(std::uint64_t number) const {
    return static_cast<int>(std::upper_bound(begin_.begin(), begin_.end(), number) - begin_.begin()) - 1;
  }
  bool is_here(std::uint64_t number) const { return number >= first() && number < begin_[rank_ + 1]; }
  /// \pre is_here(number)
  std::size_t index(std::uint64_t number) const { return static_cast<std::size_t>(number - first()); }

 private:
  std::size_t rank_;
  std::vector<std::uint64_t> begin_;  // by rank, and the end
};

}  // namespace powercell
