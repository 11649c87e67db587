/// \file
/// Needs of drivers beyond the OpenCL specification, in one table (quirks.cpp). Internal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <powercell/device.hpp>

namespace powercell::cl {

/// How the library treats one device. The defaults suit an unknown driver.
struct Quirks {
  /// clBuildProgram leaves kernels unfinished: each is compiled at its first launch with a group size.
  bool compiles_at_launch = false;
  /// The driver keeps compiled kernels on disk itself, so powercell's own cache would only be a second copy.
  bool keeps_programs = false;
  /// Work-items of a group, for kernels that require no number of their own. The default is for CPUs, whose
  /// drivers run a group as a loop on one thread: long enough to pay for the group, short enough to share the
  /// work evenly.
  std::size_t group_size = 32;
  /// A launch of more work-items makes the driver compile the kernel once more.
  std::uint64_t launch_limit = std::numeric_limits<std::uint64_t>::max();
  /// Pairs of a launch of DeviceDiagram for each compute unit, where 2^18 in all leave units idle.
  std::uint64_t pairs_of_unit = 0;
  /// Numbers that a work-item handles at once when it clips polygons and polyhedra: 8 or 4 in vectors, which
  /// take as many registers where work-items are lanes themselves, or 1 (LANE_WIDTH of
  /// kernels/base/lanes.cl).
  int polygon_lanes = 8, polyhedron_lanes = 8;
};

Quirks quirks_of(const DeviceInfo& device);

/// That of its quirks for cells of a dimension, unless the environment variable POWERCELL_LANES is 1, 4 or 8.
/// \throw Error invalid_argument if it is anything else
int lane_width(const DeviceInfo& device, int cell_dimension);

}  // namespace powercell::cl
