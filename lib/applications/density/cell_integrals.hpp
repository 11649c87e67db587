/// \file
/// Integrals over all cells and walls, in parallel.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "lib/applications/density/geometric.hpp"

namespace powercell {

using MakeIntegrator = std::function<std::unique_ptr<PieceIntegrator>()>;

/// The moments of every cell about its first vertex. (About the seed they would lose all digits if it is very
/// far away.) Each cell is summed by one thread, in the order of its pieces.
std::vector<Moments> cell_moments(const Cells& cells, const DomainBox& box, const MakeIntegrator& make,
                                  int threads);

/// The integrals over the walls between cells with the status ok, each computed in the cell of the lower
/// index, or in the other one if only that has the wall.
Adjacency wall_integrals(const Cells& cells, const DomainBox& box, std::span<const SeedStatus> status,
                         const MakeIntegrator& make, int threads);

}  // namespace powercell
