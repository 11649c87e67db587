/// \file
/// Surfaces with sides that face each other within the spacing of the points, cut into layers.
#pragma once

#include <cstdint>
#include <powercell/density.hpp>
#include <vector>

namespace powercell {

/// Regions of a surface such that no layer has two sides near to each other.
struct Layers {
  std::uint32_t count = 1;
  std::vector<std::uint32_t> of_region;  ///< empty if there is one
};

/// Finds the layers of a surface for n points of a density. There is one if sides are near to each other on
/// at most 1 % of the mass.
/// \param threads  on the host; 0 means all
Layers find_layers(const Domain& surface, const Density& density, std::size_t n, std::uint64_t random_seed,
                   int threads);

}  // namespace powercell
