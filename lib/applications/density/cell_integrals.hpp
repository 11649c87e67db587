/// \file
/// Integrals over all cells and walls, in parallel. Internal.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "lib/applications/density/geometric.hpp"

namespace powercell {

using MakeIntegrator = std::function<std::unique_ptr<PieceIntegrator>()>;

/// The moments of every cell about its first vertex: its seed may be so far away that nothing is left of the
/// cell beside the distance. Each cell is summed by one thread, in the order of its pieces.
std::vector<Moments> cell_moments(const Cells& cells, const Box& box, const MakeIntegrator& make,
                                  int threads);

/// The integrals over the walls between cells that have a status of ok, each from the side of the lower
/// index, or from the other where only that has it.
Adjacency wall_integrals(const Cells& cells, const Box& box, std::span<const SeedStatus> status,
                         const MakeIntegrator& make, int threads);

}  // namespace powercell
