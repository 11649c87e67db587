/// \file
/// Needs of drivers beyond the OpenCL specification, in one table (quirks.cpp).
#pragma once

#include <cstdint>
#include <limits>
#include <mutex>
#include <powercell/device_settings.hpp>

namespace powercell::cl {

/// How the library treats one device. The defaults suit an unknown driver.
struct Quirks {
  /// clBuildProgram leaves kernels unfinished: each is compiled at its first launch with a group size.
  bool compiles_at_launch = false;
  /// The driver keeps compiled kernels on disk itself, so powercell's own cache would only be a second copy.
  bool keeps_programs = false;
  /// A launch of more work-items makes the driver compile the kernel once more.
  std::uint64_t launch_limit = std::numeric_limits<std::uint64_t>::max();
  /// Two threads that call the driver at a time may wait for each other for ever (call_alone).
  bool one_thread = false;
  /// Where nothing was measured (settings_file.hpp). Groups are for kernels that require no number of their
  /// own; the default is for CPUs, whose drivers run a group as a loop on one thread: long enough to pay for
  /// the group, short enough to share the work evenly. Lanes are LANE_WIDTH of kernels/base/lanes.cl: vectors
  /// of 8 or 4 take as many registers where work-items are lanes themselves. Launches are short enough for a
  /// display driver's watchdog.
  DeviceSettings settings;
};

Quirks quirks_of(const DeviceInfo& device);

/// A lock that all devices with Quirks::one_thread share; of others one that locks nothing.
std::unique_lock<std::recursive_mutex> call_alone(const DeviceInfo& device);

/// That of the settings for cells of a dimension, unless the environment variable POWERCELL_LANES is 1, 4
/// or 8.
/// \throw Error invalid_argument if it is anything else
int lane_width(const DeviceSettings& settings, int cell_dimension);

}  // namespace powercell::cl
