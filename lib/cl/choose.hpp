/// \file
/// Finds the device that a selector names. Internal.
#pragma once

#include <powercell/device.hpp>
#include <span>
#include <string_view>

namespace powercell::cl {

/// Index into `devices` of the one that `selector` names ("P:D", "cpu", "gpu", or a case-insensitive
/// part of the device's or platform's name); of several the best. Empty: the best of all.
/// Best: a GPU before a CPU before others, then most compute units, then first.
/// \param origin  where the selector was given, for the message: "" or e.g. " (from POWERCELL_DEVICE)"
/// \throw Error device_not_found listing `devices`
std::size_t select_device(std::span<const DeviceInfo> devices, std::string_view selector,
                          std::string_view origin = {});

}  // namespace powercell::cl
