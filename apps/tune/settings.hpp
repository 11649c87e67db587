/// \file
/// The settings of a device that `powercell tune` measures, and the values that it tries.
#pragma once

#include <cstdint>
#include <powercell/device_settings.hpp>
#include <string>
#include <vector>

namespace powercell::app {

enum class UsedBy { diagram, device_diagram, both };

struct Setting {
  const char* name;
  int cell_dimension;  ///< of the cells that it concerns; 0: any
  UsedBy used_by;
  std::uint64_t (*get)(const DeviceSettings&);
  void (*set)(DeviceSettings&, std::uint64_t);
  std::vector<std::uint64_t> (*values)(std::uint64_t now);  ///< to try beside `now`
};

/// In the order in which they are measured.
const std::vector<Setting>& all_settings();
std::vector<std::string> setting_names();
/// \pre one of setting_names()
const Setting& setting(const std::string& name);

}  // namespace powercell::app
