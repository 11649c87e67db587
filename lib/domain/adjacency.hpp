/// \file
/// Which facets of regions are the same: by sorting, linear in memory and near-linear in time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

/// For each vertex the first one, in coordinate order, at the same position (-0 equals 0).
/// \param vertices nv x dimension, row-major, no NaN
std::vector<std::uint32_t> weld(std::span<const double> vertices, int dimension);

/// One facet of a region: its N vertices ascending, and the slot in RegionMesh::facet.
template <std::size_t N>
struct FacetKey {
  std::array<std::uint32_t, N> vertex;
  std::uint32_t slot;
  friend auto operator<=>(const FacetKey&, const FacetKey&) = default;
};

/// Sorts the keys and calls `group(first, last)` for each run of facets with the same vertices; within
/// a run slots ascend.
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

}  // namespace powercell
