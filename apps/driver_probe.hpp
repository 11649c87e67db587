/// \file
/// Drivers that end the process that asks for their devices.
#pragma once

#include <string>
#include <vector>

namespace powercell::app {

/// A driver that was set aside.
struct FatalDriver {
  std::string file;  ///< that names it to the OpenCL loader
  std::string last_words;
};

/// Asks for the devices in a process of its own. If that is ended, asks each driver alone, and has the OpenCL
/// loader of this process see the others only. To be called before OpenCL is used; does nothing where
/// processes cannot be started so.
/// \return those that end a process
std::vector<FatalDriver> set_fatal_drivers_aside();

/// In such a process of its own: asks for the devices and returns true.
bool is_driver_probe();

}  // namespace powercell::app
