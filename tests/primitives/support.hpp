/// \file
/// Device, sizes and random values for the tests of the primitives.
#pragma once

#include <cstdint>
#include <memory>
#include <powercell/device.hpp>
#include <random>
#include <vector>

#include "lib/cl/buffer.hpp"

namespace powercell::test {

/// The context of the default device; never destroyed.
inline std::shared_ptr<cl::Context> test_context() {
  static auto* device = new Device(Device::choose());
  return device->context();
}

/// Lengths around the sizes of tiles and levels, and large ones.
inline const std::vector<std::uint32_t> counts = {0,   1,   2,   127,  128,   129,   255,    256,
                                                  257, 511, 513, 4097, 16384, 16385, 100000, 1000003};
/// Sizes of work-groups; 0 chooses by the device.
inline const std::vector<std::size_t> group_sizes = {0, 1, 8, 64};

template <class T>
std::vector<T> random_values(std::size_t count, T most) {
  std::mt19937_64 generator(count + 1);
  std::uniform_int_distribution<T> value(0, most);
  std::vector<T> values(count);
  for (T& v : values) v = value(generator);
  return values;
}

}  // namespace powercell::test
