/// \file
/// Clips a box to a power cell whose neighbours are known, in double: the part of a peer's work that its
/// triangulation does not do.
#pragma once

#include <cstdint>
#include <span>

#include "tests/support/generators.hpp"

namespace powercell::bench {

/// Area of the intersection of the box and the cell of seed i.
/// \param neighbors  all seeds whose bisectors with i bound the cell
double cell_area_in_box(const SeedsView& seeds, std::size_t i, std::span<const std::uint32_t> neighbors,
                        const test::Box& box);
/// The volume, for seeds in space, by voro++'s cell.
double cell_volume_in_box(const SeedsView& seeds, std::size_t i, std::span<const std::uint32_t> neighbors,
                          const test::Box& box);

}  // namespace powercell::bench
