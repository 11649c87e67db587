/// \file
/// Finds the facets that regions share, by sorting: linear in memory, near-linear in time. Internal.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// One facet of a region: its N vertices ascending, and the slot in RegionMesh::facet.
template <std::size_t N>
struct FacetKey {
  std::array<std::uint32_t, N> vertex;
  std::uint32_t slot;
  friend auto operator<=>(const FacetKey&, const FacetKey&) = default;
};

/// Sorts the keys and calls `group` with each run of facets that have the same vertices; slots ascend in a
/// run.
template <std::size_t N, class Group>
void for_each_shared(std::vector<FacetKey<N>>& keys, Group&& group) {
  std::sort(keys.begin(), keys.end());
  for (auto first = keys.cbegin(); first != keys.cend();) {
    auto last = first + 1;
    while (last != keys.cend() && last->vertex == first->vertex) ++last;
    group(std::span<const FacetKey<N>>(first, last));
    first = last;
  }
}

/// Numbers the facets whose kind is `boundary`, in the order of their slots.
void number_boundary(RegionMesh& mesh);

}  // namespace powercell
