/// \file
/// All configurations of a diagram on this machine: device x precision x neighbour provider.
#pragma once

#include <powercell/device.hpp>
#include <powercell/options.hpp>
#include <string>
#include <vector>

namespace powercell::test {

struct Setup {
  std::string name;  ///< e.g. "0:0 double tree"
  Device device;
  Options options;
};

/// All configurations, with devices made once for the process. POWERCELL_DEVICE, if set, restricts them to
/// one device.
const std::vector<Setup>& all_setups();
/// The first device with its best precision and each provider.
const std::vector<Setup>& main_setups();

/// POWERCELL_DEVICE, or the default device; chosen once. Never released: at the end of the process the driver
/// may be gone before it (oclgrind is).
const Device& test_device();

/// 2^-53 or 2^-24.
double unit_roundoff(Precision precision);

}  // namespace powercell::test
