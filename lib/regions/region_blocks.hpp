/// \file
/// The regions and their groups in blocks of eight, one vector per coordinate.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "lib/base/compiler.hpp"
#include "lib/domain/region_mesh.hpp"
#include "lib/regions/region_groups.hpp"

namespace powercell {

constexpr std::size_t lane_count = 8;

/// One coordinate of eight boxes or points.
using Lanes = std::array<double, lane_count>;

namespace lanes {

using Vector POWERCELL_VECTOR(lane_count * sizeof(double)) = double;

POWERCELL_ALWAYS_INLINE void load(const void* from, Vector& to) {
  std::memcpy(&to, from, sizeof to);
}
POWERCELL_ALWAYS_INLINE void store(const Vector& from, void* to) {
  std::memcpy(to, &from, sizeof from);
}

}  // namespace lanes

/// A block holds the members of one group; a group of fewer than eight repeats its last member.
struct RegionBlocks {
  int dimension;
  std::vector<std::vector<Lanes>>
      box;  ///< per level of the members: low, then high coordinates of each block
  std::vector<std::uint64_t> corner_offset;  ///< blocks of regions + 1, into `corner`
  std::vector<Lanes> corner;  ///< corner by corner; a region with fewer corners repeats its last one

  RegionBlocks(const RegionMesh& mesh, const RegionGroups& groups);

  const Lanes* boxes(std::size_t level, std::size_t block) const {
    return &box[level][block * 2 * static_cast<std::size_t>(dimension)];
  }
  /// Finds, for each member of a block, the largest separation of its box from the box [low, high] along any
  /// axis; negative where they overlap.
  /// \param low, high  relative to `origin`
  void find_gaps(std::size_t level, std::size_t block, const double* origin, const double* low,
                 const double* high, Lanes& gap) const;
};

}  // namespace powercell
