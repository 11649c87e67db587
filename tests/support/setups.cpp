#include "tests/support/setups.hpp"

#include <cstdlib>

namespace powercell::test {

namespace {

std::vector<Device> test_devices() {
  const char* chosen = std::getenv("POWERCELL_DEVICE");
  if (chosen && *chosen) return {Device::choose()};
  std::vector<Device> list;
  for (const DeviceInfo& info : devices()) list.push_back(Device::choose(info.selector()));
  return list;
}

std::vector<Setup> make_setups() {
  std::vector<Setup> setups;
  for (const Device& device : test_devices())
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      if (precision == Precision::float64 && !device.info().fp64) continue;
      for (const Neighbors neighbors : {Neighbors::tree, Neighbors::flann}) {
#ifndef POWERCELL_TEST_FLANN
        if (neighbors == Neighbors::flann) continue;
#endif
        Options options;
        options.precision = precision;
        options.neighbors = neighbors;
        setups.push_back({device.info().selector() +
                              (precision == Precision::float64 ? " double" : " float") +
                              (neighbors == Neighbors::tree ? " tree" : " flann"),
                          device, options});
      }
    }
  return setups;
}

}  // namespace

const std::vector<Setup>& all_setups() {
  static const std::vector<Setup> setups = make_setups();
  return setups;
}

const Device& test_device() {
  static const auto* device = new Device(Device::choose());
  return *device;
}

const std::vector<Setup>& main_setups() {
  static const std::vector<Setup> setups = [] {
    std::vector<Setup> some;
    for (const Setup& setup : all_setups())
      if (setup.options.precision == all_setups().front().options.precision &&
          setup.device.context() == all_setups().front().device.context())
        some.push_back(setup);
    return some;
  }();
  return setups;
}

double unit_roundoff(Precision precision) {
  return precision == Precision::float32 ? 0x1.0p-24 : 0x1.0p-53;
}

}  // namespace powercell::test
