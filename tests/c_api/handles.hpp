/// \file
/// Handles of the C interface that free themselves, and a small diagram.
#pragma once

#include <doctest/doctest.h>
#include <powercell.h>

#include <limits>
#include <string>
#include <vector>

namespace powercell::c_api_test {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double low[3] = {0, 0, 0};
constexpr double high[3] = {2, 1, 1};

/// Owns a handle, or a result that the caller destroys.
template <class Handle, void (*Destroy)(Handle*)>
struct Owned {
  Owned() = default;
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { Destroy(handle); }
  Handle* operator->() const { return handle; }
  Handle* handle = nullptr;
};
using Device = Owned<pc_device, pc_device_destroy>;
using Domain = Owned<pc_domain, pc_domain_destroy>;
using Diagram = Owned<pc_diagram, pc_diagram_destroy>;
using Results = Owned<pc_results, pc_results_destroy>;

inline pc_device* shared_device() {
  static Device device;
  if (!device.handle) REQUIRE(pc_device_create(nullptr, &device.handle) == PC_OK);
  return device.handle;
}

/// A diagram of four seeds in a 2 x 1 box, on a grid, so that each cell is a quarter.
struct Grid {
  Domain domain;
  Diagram diagram;
  std::vector<double> positions = {0.5, 0.25, 1.5, 0.25, 0.5, 0.75, 1.5, 0.75};
  Grid() {
    REQUIRE(pc_domain_box(low, high, 2, &domain.handle) == PC_OK);
    REQUIRE(pc_diagram_create(shared_device(), domain.handle, nullptr, &diagram.handle) == PC_OK);
    REQUIRE(pc_diagram_set_seeds(diagram.handle, positions.data(), nullptr, 4) == PC_OK);
  }
};

inline bool message_has(const std::string& part) {
  return std::string(pc_last_error()).find(part) != std::string::npos;
}

}  // namespace powercell::c_api_test
