#include "lib/diagram/device_errors.hpp"

#include "lib/cl/errors.hpp"

namespace powercell {

void rethrow_of(const Setup& setup, const Device& device, const Error& error) {
  if (setup.members.size() == 1 || !cl::is_of_device(error.code())) throw error;
  throw Error(error.code(), "device " + device.info().selector() + " \"" + device.info().name +
                                "\" of a group: " + error.what());
}

}  // namespace powercell
