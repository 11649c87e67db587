/// \file
/// Rows of results, brought to the rank that writes them.
#pragma once

#include <cstdint>
#include <powercell/distributed.hpp>

#include "apps/cell_files.hpp"
#include "apps/ranks/ranks.hpp"

namespace powercell::app {

struct RowRange {
  std::uint64_t begin, end;
};

/// The rows of a file that a rank reads, and has the results of.
RowRange rows_of_rank(std::uint64_t rows, int rank, int ranks);

/// Writes the cells of all ranks from the first one, some rows at a time. All ranks call it.
/// \param own  of the rows of this rank, in their order
/// \throw Error of CellFiles
void write_rows(Ranks& ranks, const DistributedCells& own, std::uint64_t rows, CellFiles& files);

}  // namespace powercell::app
