/// \file
/// What holds of a treemap of any tree.
#pragma once

#include <cstdint>
#include <powercell/treemap.hpp>
#include <span>

namespace powercell::fuzz {

/// Arrays that fit the tree; leaves that fill the outline, each with its share of the area to `tolerance` and
/// rounding of its corners, unless the layout says that it did not converge. \param parent  by node, -1 for
/// the root \throw Finding where not
void check_treemap(const Treemap& map, std::span<const std::int64_t> parent, double tolerance);

}  // namespace powercell::fuzz
