/// \file
/// How kernels are launched on a device, as `powercell tune` measures it. Only speed depends on it: measures,
/// adjacency and cells have the same bits with any settings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <powercell/device.hpp>
#include <powercell/export.hpp>
#include <string>

namespace powercell {

struct DeviceSettings {
  /// Work-items of a group: a power of two, at most 1024 and what the device permits.
  std::size_t group_size = 32;
  /// Numbers that a work-item handles at once where it clips polygons and polyhedra: 1, 4 or 8. The
  /// environment variable POWERCELL_LANES overrules both.
  int polygon_lanes = 8, polyhedron_lanes = 8;
  /// Pairs of a region and a seed that Diagram clips at a time, 1024 to 2^22, where `Options::chunk_pairs` is
  /// 0. On CPUs never more than a driver takes without compiling kernels again.
  std::uint64_t chunk_pairs = std::uint64_t{1} << 18;
  /// Pairs of a launch of DeviceDiagram, 1024 to 2^26, likewise.
  std::uint64_t launch_pairs = std::uint64_t{1} << 18;

  friend bool operator==(const DeviceSettings&, const DeviceSettings&) = default;
};

/// Those that the library has for a device of this kind and maker, whatever was measured on it.
POWERCELL_API DeviceSettings default_settings(const DeviceInfo& device);
/// Those in use: read from `settings_file` when the device was opened, else the defaults.
/// \throw Error unsupported for a group
POWERCELL_API DeviceSettings settings_of(const Device& device);
/// Changes those in use, for all copies of `device`. To be called before the first diagram on it.
/// \throw Error invalid_argument for settings out of range; unsupported for a group
POWERCELL_API void use_settings(const Device& device, const DeviceSettings& settings);

/// The file of measured settings of a device, in the folder of compiled kernels (POWERCELL_CACHE_DIR); it
/// need not exist. A file that is malformed, or of another device, driver or version of the library, is
/// ignored when the device is opened, with a line in the log. Empty if there is no such folder.
POWERCELL_API std::string settings_file(const DeviceInfo& device);
/// Writes that file, as a whole or not at all, for devices opened from now on.
/// \throw Error invalid_argument for settings out of range; write_failed
POWERCELL_API void save_settings(const DeviceInfo& device, const DeviceSettings& settings);
/// Removes that file.
/// \return whether there was one.
/// \throw Error write_failed
POWERCELL_API bool remove_settings(const DeviceInfo& device);

}  // namespace powercell
