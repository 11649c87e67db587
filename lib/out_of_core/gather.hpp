/// \file
/// The cells of pieces in files, in the order of the seeds' indices.
#pragma once

#include <cstdint>
#include <functional>
#include <powercell/out_of_core.hpp>
#include <vector>

#include "lib/out_of_core/piece_file.hpp"
#include "lib/out_of_core/sorting.hpp"

namespace powercell::out_of_core {

/// Gives the cells of all seeds to a function, ascending, some at a time. Seeds that no piece has are
/// duplicates. Enters numbers and sums of cells in the report.
/// \param seeds  of all pieces and the duplicates together
void gather(const std::vector<PieceFile>& pieces, std::uint64_t seeds, int dimension, double domain_measure,
            std::size_t rows, const std::function<void(CellRows)>& take, Traffic& traffic,
            OutOfCoreReport& report);

}  // namespace powercell::out_of_core
