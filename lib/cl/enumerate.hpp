/// \file
/// The OpenCL devices of this machine with their handles. Internal.
#pragma once

#include <vector>

#include "lib/cl/context.hpp"

namespace powercell::cl {

struct FoundDevice {
  cl_platform_id platform;
  cl_device_id device;
  DeviceInfo info;
};

/// As powercell::devices(), with handles. Devices that report themselves not available or that have no
/// compiler are left out; the others keep their index.
std::vector<FoundDevice> find_devices();

/// The properties that `device` reports; the indices stay 0.
DeviceInfo describe(cl_platform_id platform, cl_device_id device);

/// A text the driver reports, without the terminating zero. \throw Error opencl
std::string platform_text(cl_platform_id platform, cl_platform_info which);

}  // namespace powercell::cl
