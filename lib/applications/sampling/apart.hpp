/// \file
/// Parts of cells that are apart from their points. Internal.
#pragma once

#include <powercell/sampling.hpp>
#include <span>

namespace powercell {

/// Finds the connected parts of each cell: pieces that share a facet between regions of the domain.
/// \param positions  n x d: the points of the cells
PartsApart parts_apart(const Cells& cells, std::span<const double> positions);

}  // namespace powercell
