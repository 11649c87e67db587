/// \file
/// Finds the facets that regions share, by sorting: linear in memory, near-linear in time.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
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
  friend std::strong_ordering operator<=>(const FacetKey&, const FacetKey&) = default;
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

/// Appends to `repeated` the regions of a run that have the same opposite vertex as one before, and so all
/// corners.
/// \param apex  apex(slot): the vertex opposite the facet
/// \return whether there are any
template <std::size_t N, class Apex>
bool add_repeated(std::span<const FacetKey<N>> shared, const RegionMesh& mesh, const Apex& apex,
                  std::vector<std::array<std::uint32_t, 2>>& repeated) {
  if (shared.size() < 2 || (shared.size() == 2 && apex(shared[0].slot) != apex(shared[1].slot))) return false;
  std::vector<std::array<std::uint32_t, 2>> opposite;
  for (const FacetKey<N>& key : shared)
    opposite.push_back({apex(key.slot), mesh.source[key.slot / static_cast<std::uint32_t>(N + 1)]});
  std::sort(opposite.begin(), opposite.end());
  const std::size_t before = repeated.size();
  for (std::size_t k = 1, first = 0; k < opposite.size(); ++k) {
    if (opposite[k][0] != opposite[first][0])
      first = k;
    else
      repeated.push_back({opposite[k][1], opposite[first][1]});
  }
  return repeated.size() > before;
}

/// Sorts pairs and drops copies: a region is found at each of its facets.
std::vector<std::array<std::uint32_t, 2>> distinct(std::vector<std::array<std::uint32_t, 2>> repeated);

/// Numbers the facets whose kind is `boundary`, in the order of their slots.
void number_boundary(RegionMesh& mesh);

}  // namespace powercell
