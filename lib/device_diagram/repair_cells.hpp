/// \file
/// Results of some cells put among those of all, in the repair of a DeviceDiagram: rows of walls, boundary
/// walls and geometry.
#pragma once

#include <cstdint>
#include <powercell/opencl.hpp>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/cl/context.hpp"
#include "lib/device_diagram/geometry.hpp"
#include "lib/domain/period.hpp"

namespace powercell {

/// Reads the geometry from the caller's buffers. Waits.
/// \param d  coordinates of a vertex
/// \throw Error invalid_argument if not all cells have been written for lack of room; opencl
Cells read_cells(const std::shared_ptr<cl::Context>& context, const DeviceCells& from, std::uint32_t n, int d,
                 bool float32, const CellRooms& room);

/// \param all     the cells of all seeds
/// \param listed  the seeds whose cells are replaced, each once
/// \param exact   these cells, in this order
/// \return the cells of all seeds
Cells merge_cells(const Cells& all, std::span<const std::uint32_t> listed, const Cells& exact);

/// \throw Error invalid_argument if the cells do not fit the caller's buffers (how many there are)
void require_room(const Cells& cells, const CellRooms& room);
/// Writes the geometry to the caller's buffers.
/// \pre there is room
/// \throw Error opencl
void write_cells(const cl::Context& context, const DeviceCells& to, const Cells& cells, bool float32);

/// Reads the rows from the caller's buffers. Waits.
/// \param room  entries that fit the buffers
/// \throw Error invalid_argument if some rows have not been written for lack of room; opencl
BoundaryWalls read_boundary(const std::shared_ptr<cl::Context>& context, const DeviceBoundaryWalls& from,
                            std::uint32_t n, bool float32, std::uint32_t room);

/// \param all     the rows of all seeds
/// \param listed  the seeds whose rows are replaced, each once
/// \param exact   these rows, in this order
/// \return the rows of all seeds
BoundaryWalls merge_boundary(const BoundaryWalls& all, std::span<const std::uint32_t> listed,
                             const BoundaryWalls& exact);

/// \throw Error invalid_argument if the rows do not fit the caller's buffers (how many entries there are)
void require_room(const BoundaryWalls& walls, std::uint32_t room);
/// Writes the rows to the caller's buffers.
/// \pre there is room
/// \throw Error opencl
void write_boundary(const cl::Context& context, const DeviceBoundaryWalls& to, const BoundaryWalls& walls,
                    bool float32);

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
/// \return symmetric rows, ascending
/// \throw Error invalid_argument (more entries than `room`; how many)
template <class Real>
DeviceRows<Real> merge_rows(const DeviceRows<Real>& all, std::span<const std::uint32_t> listed,
                            const Adjacency& exact, const std::vector<bool>& has_cell, std::uint32_t room);

}  // namespace powercell
