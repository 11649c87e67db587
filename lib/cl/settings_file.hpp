/// \file
/// The file of settings measured on a device: its text, and which text is believed.
#pragma once

#include <optional>
#include <powercell/device_settings.hpp>
#include <string>
#include <string_view>

namespace powercell::cl {

/// \throw Error invalid_argument unless the settings can be used on the device
void require_usable(const DeviceInfo& device, const DeviceSettings& settings);

/// The text of the file: lines of a key, a space and a value, in a fixed order; the last is `end`.
std::string settings_text(const DeviceInfo& device, const DeviceSettings& settings);

struct ReadSettings {
  std::optional<DeviceSettings> settings;
  std::string fault;  ///< why there are none
};
/// Settings of this device, its driver and this version of the library from `text`, which may be anything.
ReadSettings parse_settings(const DeviceInfo& device, std::string_view text);

/// Those of `settings_file`, with a line in the log; the defaults if there is none, or none that is believed.
DeviceSettings measured_settings(const DeviceInfo& device);

}  // namespace powercell::cl
