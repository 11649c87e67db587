/// \file
/// The inner loop of the search for neighbours: seeds in columns against the box of a cell. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

namespace powercell::treemap_detail {

/// Seed i and the box of its cell, relative to it.
struct ScanBox {
  double x, y, weight;
  double low_x, high_x, low_y, high_y;
};

/// Writes to `found` the seeds of [0, count) that may cut the cell, mathematics (10), in order; returns how
/// many.
std::size_t scan_candidates(std::size_t count, const double* x, const double* y, const double* weight,
                            const ScanBox& box, std::uint32_t* found);

}  // namespace powercell::treemap_detail
