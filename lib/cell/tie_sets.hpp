/// \file
/// Seeds by the thousand that tie in one point, such as those of a sphere in its centre.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lib/cell/exact_cell.hpp"
#include "lib/cell/host_clip.hpp"

namespace powercell {

/// Sets of seeds that are equally near to a point to which no other seed is as near. Once a set is known,
/// cells with a vertex there need no search and few exact decisions (docs/mathematics.md (86c)). Each thread
/// needs its own.
class TieSets {
 public:
  /// Smaller sets are not kept: it takes longer to look them up.
  static constexpr std::size_t least = 32;

  explicit TieSets(const HostScene& scene) : scene_(scene) {}

  /// Keeps a set.
  /// \param ranks  all of its seeds, in any order
  void learn(std::vector<std::uint32_t> ranks);
  /// The set that all of these seeds belong to, or null.
  const std::vector<std::uint32_t>* find(std::span<const std::uint32_t> corners) const;
  /// A seed of the set that takes the point from the others once infinitesimals (86) are counted; none if no
  /// seed does.
  /// \param set  of find()
  /// \param corners  the seeds of a vertex: that of the cell, then its neighbours
  /// \param vertex  the same as borders
  /// \param exact  decides what rounding leaves open
  std::optional<std::uint32_t> taker(const std::vector<std::uint32_t>& set,
                                     std::span<const std::uint32_t> corners, const ExactVertex& vertex,
                                     ExactCell& exact) const;

 private:
  struct Set {
    std::vector<std::uint32_t> ranks;  ///< the one that breaks ties first comes first
    std::vector<bool> has;             ///< by rank
  };
  /// More sets than this are forgotten, the oldest first.
  static constexpr std::size_t most = 8;

  const HostScene& scene_;
  std::vector<Set> sets_;
};

}  // namespace powercell
