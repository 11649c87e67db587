/// \file
/// A power cell in a box cut by its known neighbours, in double: the part of a peer's work that a
/// triangulation does not do by itself.
#pragma once

#include <cstdint>
#include <span>

#include "tests/support/generators.hpp"

namespace powercell::bench {

/// Area of box ∩ cell of seed i, where `neighbors` are all seeds whose bisectors bound the cell.
double cell_area_in_box(const SeedsView& seeds, std::size_t i, std::span<const std::uint32_t> neighbors,
                        const test::Box& box);
/// Volume of the same in space, with voro++'s cell.
double cell_volume_in_box(const SeedsView& seeds, std::size_t i, std::span<const std::uint32_t> neighbors,
                          const test::Box& box);

}  // namespace powercell::bench
