/// \file
/// The OpenCL devices of this machine with their handles.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lib/cl/context.hpp"

namespace powercell::cl {

struct FoundDevice {
  cl_platform_id platform;
  cl_device_id device;
  DeviceInfo info;
};

struct FoundDevices {
  std::vector<FoundDevice> usable;
  std::vector<UnusableDevice> unusable;
};

/// All devices of all platforms in the order of the ICD loader. A platform or device that OpenCL cannot
/// describe, is not available or has no compiler is set aside, with a line in the log; the others keep their
/// index.
/// \throw Error opencl (the platforms cannot be listed), unsupported (a forked process)
FoundDevices find_devices();

/// "the device 0:0 NAME" or "the platform 0 NAME".
std::string describe(const UnusableDevice& unusable);

/// "; the device 0:0 NAME: REASON" and so on, for messages.
std::string reasons(std::span<const UnusableDevice> unusable);

/// Why there may be no device, and what to do.
/// \param unusable  those that were set aside
std::string no_device_message(std::span<const UnusableDevice> unusable);

/// Sets the indices by which Device::choose finds the device. Asks no other platform anything.
/// \throw Error opencl
void find_indices(cl_platform_id platform, cl_device_id device, DeviceInfo& info);

/// The properties that `device` reports; the indices stay 0.
DeviceInfo describe(cl_platform_id platform, cl_device_id device);

/// A text the driver reports, without the terminating zero.
/// \throw Error opencl
std::string platform_text(cl_platform_id platform, cl_platform_info which);

}  // namespace powercell::cl
