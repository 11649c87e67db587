#include "lib/c_api/handles.hpp"

namespace powercell::c_api {
extern "C" {

pc_status pc_device_create(const char* selector, pc_device** device) {
  return guarded([&] {
    result_at(device);
    hand_over(device, Device::choose(selector ? selector : ""));
  });
}

void pc_device_destroy(pc_device* device) {
  delete device;
}

const char* pc_device_name(const pc_device* device) {
  return device ? device->device.info().name.c_str() : nullptr;
}

}  // extern "C"
}  // namespace powercell::c_api
