/// \file
/// The boundary walls of some cells put among those of all, in the repair of a DeviceDiagram. Internal.
#pragma once

#include <cstdint>
#include <powercell/opencl.hpp>
#include <powercell/results.hpp>
#include <span>

#include "lib/cl/context.hpp"

namespace powercell {

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
/// Writes the rows to the caller's buffers. \pre there is room  \throw Error opencl
void write_boundary(const cl::Context& context, const DeviceBoundaryWalls& to, const BoundaryWalls& walls,
                    bool float32);

}  // namespace powercell
