/// \file
/// What the handles of the C interface hold.
#pragma once

#include <powercell/c/diagram.h>

#include <powercell/device.hpp>
#include <powercell/diagram.hpp>
#include <powercell/domain.hpp>

#include "lib/c_api/calls.hpp"

struct pc_device {
  explicit pc_device(powercell::Device opened) : device(std::move(opened)) {}
  powercell::Device device;
};

struct pc_domain {
  explicit pc_domain(powercell::Domain made) : domain(std::move(made)) {}
  powercell::Domain domain;
};

struct pc_diagram {
  explicit pc_diagram(powercell::Diagram made) : diagram(std::move(made)) {}
  powercell::Diagram diagram;
};

namespace powercell::c_api {

inline const Device& device_in(const pc_device* handle) {
  return checked(handle, "device").device;
}
inline const Domain& domain_in(const pc_domain* handle) {
  return checked(handle, "domain").domain;
}
inline Diagram& diagram_in(pc_diagram* handle) {
  return checked(handle, "diagram").diagram;
}
inline const Diagram& diagram_in(const pc_diagram* handle) {
  return checked(handle, "diagram").diagram;
}

/// Seeds of the caller in a space of `dimension` coordinates.
inline SeedsView seeds_of(int dimension, const double* positions, const double* weights, std::size_t count) {
  return {dimension, rows_view(positions, count, static_cast<std::size_t>(dimension), "positions"),
          optional_view(weights, count)};
}

}  // namespace powercell::c_api
