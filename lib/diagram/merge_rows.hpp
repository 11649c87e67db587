/// \file
/// Exact rows of some cells put among the rows of all. Internal.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/domain/period.hpp"

namespace powercell {

/// An adjacency as DeviceDiagram writes it.
template <class Real>
struct DeviceRows {
  std::vector<std::uint32_t> offset, neighbor;
  std::vector<Real> wall;
  bool has_shifts = false;   ///< of a periodic domain
  std::vector<Shift> shift;  ///< per entry, where there are any
};

/// Replaces all walls of some cells. Another cell keeps its walls with its like, and has those walls with the
/// listed cells that these have with it: cells that are not listed are certain of their own walls, so that
/// the exact rows of the others agree with them. A wall of two listed cells has the mean of its sides, as in
/// Diagram.
/// \param all       rows of all cells
/// \param listed    the cells to replace, each once
/// \param exact     their rows, in this order, with neighbours by index among all
/// \param has_cell  by seed; those without a cell get no walls
/// \param room      entries that the result may have
/// \return symmetric rows, ascending \throw Error invalid_argument (more entries than `room`; how many)
template <class Real>
DeviceRows<Real> merge_rows(const DeviceRows<Real>& all, std::span<const std::uint32_t> listed,
                            const Adjacency& exact, const std::vector<bool>& has_cell, std::uint32_t room);

}  // namespace powercell
