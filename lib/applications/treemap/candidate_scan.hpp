/// \file The inner loop of the neighbour search: tests seeds, stored in columns, against the box of a cell.
#pragma once

#include <cstddef>
#include <cstdint>

namespace powercell::treemap_detail {

/// A seed, and the bounding box of its cell relative to it.
struct ScanBox {
  double x, y, weight;
  double low_x, high_x, low_y, high_y;
};

/// Finds the seeds of [0, count) that may cut the cell, (10).
/// \param found  output, ascending; room for `count`
/// \return their number
std::size_t scan_candidates(std::size_t count, const double* x, const double* y, const double* weight,
                            const ScanBox& box, std::uint32_t* found);

}  // namespace powercell::treemap_detail
