/// \file
/// Shares a row of items out to devices by their speeds. Internal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace powercell {

/// Hands the items [0, total) out in ascending ranges that all take about the same time, and shorter ones
/// towards the end, so that all devices end together. Not thread-safe.
class Sharing {
 public:
  struct Member {
    std::uint64_t most = 0;  ///< items of a range
    double speed = 0;        ///< items a second; 0 where it is not known
  };
  struct Range {
    std::uint64_t begin = 0, end = 0;
    bool empty() const { return begin == end; }
  };

  /// \param least  items of a range that are worth a launch; the last range may have fewer
  Sharing(std::uint64_t total, std::uint64_t least, const std::vector<Member>& members);

  /// The next range for a member, which takes part from its first range on. Empty if nothing is left, or if
  /// the others would end before this member had done its part; it has left then.
  Range take(std::size_t member);
  /// How long a range took. Later ones count as much as all before them.
  void took(std::size_t member, std::uint64_t items, double seconds);
  /// Ranges of this member have at most so many items from now on.
  void limit(std::size_t member, std::uint64_t most);

  double speed(std::size_t member) const { return members_[member].speed; }

 private:
  struct State : Member {
    bool takes_part = false;
  };
  std::uint64_t size_for(std::size_t member) const;
  /// The sum of the speeds of all that take part, but `member`.
  double speed_of_others(std::size_t member) const;

  std::uint64_t total_, least_, next_ = 0;
  std::vector<State> members_;
};

}  // namespace powercell
