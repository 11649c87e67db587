/// \file
/// Finds the device that a selector names.
#pragma once

#include <powercell/device.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace powercell::cl {

/// Index into `devices` of the one that `selector` names ("P:D", "cpu", "gpu", or a case-insensitive
/// part of the device's or platform's name); of several the best. Empty: the best of all.
/// Best: a GPU before a CPU before others, a GPU with memory of its own before one without, then most lanes
/// times clock, then first.
/// \param origin  where the selector was given, for the message: "" or e.g. " (from POWERCELL_DEVICE)"
/// \throw Error device_not_found listing `devices`
std::size_t select_device(std::span<const DeviceInfo> devices, std::string_view selector,
                          std::string_view origin = {});

/// The same for selectors with commas between, in their order, and for "all": all devices, the best first.
/// \throw Error as select_device; invalid_argument (a device that is named twice)
std::vector<std::size_t> select_devices(std::span<const DeviceInfo> devices, std::string_view selectors,
                                        std::string_view origin = {});

/// For what is that of one device.
/// \throw Error unsupported if `device` is a group; names `what`
void require_single(const Device& device, std::string_view what);

}  // namespace powercell::cl
