#include "lib/diagram/device_errors.hpp"

namespace powercell {
namespace {

bool is_of_device(ErrorCode code) {
  switch (code) {
    case ErrorCode::opencl:
    case ErrorCode::out_of_device_memory:
    case ErrorCode::build_failed:
    case ErrorCode::self_test_failed:
      return true;
    default:
      return false;
  }
}

}  // namespace

void rethrow_of(const Setup& setup, const Device& device, const Error& error) {
  if (setup.members.size() == 1 || !is_of_device(error.code())) throw error;
  throw Error(error.code(), "device " + device.info().selector() + " \"" + device.info().name +
                                "\" of a group: " + error.what());
}

}  // namespace powercell
