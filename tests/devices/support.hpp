/// \file
/// Groups of devices for tests, and what they computed.
#pragma once

#include <powercell/diagram.hpp>
#include <vector>

#include "lib/diagram/state.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {

/// The device of a setup opened so many times: devices of one kind on any machine.
inline Device opened_again(const Device& device, std::size_t times) {
  std::vector<Device> members;
  for (std::size_t k = 0; k < times; ++k) members.push_back(Device::choose(device.info().selector()));
  return Device::group(members);
}

/// The pairs that each member has clipped in the last pass of a diagram.
inline std::vector<std::uint64_t> shares(const Diagram& diagram) {
  std::vector<std::uint64_t> pairs;
  for (const DeviceWorkspace& device : diagram.state().workspace.devices) pairs.push_back(device.pairs);
  return pairs;
}

}  // namespace powercell::test
