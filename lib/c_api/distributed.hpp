/// \file
/// Cells of one rank as a struct of C, and the C++ struct that it points into.
#pragma once

#include <powercell/c/distributed.h>

#include <powercell/distributed.hpp>

#include "lib/c_api/results.hpp"

namespace powercell::c_api {

/// What a pc_distributed_cells points into.
struct CellsOfRank {
  DistributedCells cells;
  pc_measures measures{};
  pc_exchange_report report{};
};

void hand_over_cells(const pc_distributed_cells** out, DistributedCells cells);

/// The cells of a struct that hand_over_cells() made.
const DistributedCells& cells_in(const pc_distributed_cells* cells);

}  // namespace powercell::c_api
