/// \file
/// The geometry of some cells put among that of all, in the repair of a DeviceDiagram. Internal.
#pragma once

#include <cstdint>
#include <powercell/opencl.hpp>
#include <powercell/results.hpp>
#include <span>

#include "lib/diagram/device_geometry.hpp"

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
/// Writes the geometry to the caller's buffers. \pre there is room  \throw Error opencl
void write_cells(const cl::Context& context, const DeviceCells& to, const Cells& cells, bool float32);

}  // namespace powercell
