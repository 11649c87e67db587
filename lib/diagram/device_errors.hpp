/// \file
/// Errors of a device in a group name it.
#pragma once

#include <powercell/device.hpp>

#include "lib/diagram/setup.hpp"

namespace powercell {

/// Throws `error` again, with the name of the device before its message if it comes from the device and this
/// is one of several.
[[noreturn]] void rethrow_of(const Setup& setup, const Device& device, const Error& error);

/// Calls `body`, which uses a device of the setup.
template <class Body>
decltype(auto) on_device(const Setup& setup, const Device& device, const Body& body) {
  try {
    return body();
  } catch (const Error& error) {
    rethrow_of(setup, device, error);
  }
}

}  // namespace powercell
