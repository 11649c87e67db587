/// \file
/// What the handles of the C interface hold.
#pragma once

#include <powercell/c/diagram.h>

#include <optional>
#include <powercell/device.hpp>
#include <powercell/diagram.hpp>
#include <powercell/domain.hpp>

#include "lib/c_api/calls.hpp"

namespace powercell::c_api {

/// A struct of C about a device, and the text that it points to.
struct DeviceText {
  explicit DeviceText(DeviceInfo info);
  DeviceInfo owned;
  std::string selector;
  pc_device_info view() const;
};

/// Structs that point into the results of a diagram.
struct ResultViews {
  pc_measures measures;
  pc_adjacency adjacency;
  pc_cells cells;
  pc_joined_cells joined;
  pc_boundary_walls boundary_walls;
  pc_dual dual;
};

}  // namespace powercell::c_api

struct pc_device {
  explicit pc_device(powercell::Device opened)
      : device(std::move(opened)), text(device.info()), info(text.view()) {}
  powercell::Device device;
  powercell::c_api::DeviceText text;
  pc_device_info info;  // points into `text`
};

struct POWERCELL_API pc_domain {
  explicit pc_domain(powercell::Domain made);
  powercell::Domain domain;
  std::vector<std::string> notes;
  std::vector<const char*> note_pointers;
  pc_domain_info info;
  pc_mesh_report report;
  pc_regions regions;
};

struct pc_diagram {
  explicit pc_diagram(powercell::Diagram&& made) : own(std::move(made)), diagram(&*own) {}
  /// Of another handle, which keeps the diagram.
  explicit pc_diagram(powercell::Diagram& of_another) : diagram(&of_another) {}

  std::optional<powercell::Diagram> own;
  powercell::Diagram* diagram;
  std::shared_ptr<powercell::c_api::ResultViews> views = std::make_shared<powercell::c_api::ResultViews>();
  pc_timings timings{};
};

struct pc_results {
  std::shared_ptr<const void> results;
  std::shared_ptr<powercell::c_api::ResultViews> views;
};

namespace powercell::c_api {

inline const Device& device_in(const pc_device* handle) {
  return checked(handle, "device").device;
}
inline const Domain& domain_in(const pc_domain* handle) {
  return checked(handle, "domain").domain;
}
inline Diagram& diagram_in(pc_diagram* handle) {
  return *checked(handle, "diagram").diagram;
}
inline const Diagram& diagram_in(const pc_diagram* handle) {
  return *checked(handle, "diagram").diagram;
}

inline std::size_t coordinates(int dimension) {
  require(dimension == 2 || dimension == 3, "dimension must be 2 or 3");
  return static_cast<std::size_t>(dimension);
}

/// Positions of the caller in a space of `dimension` coordinates.
inline std::span<const double> positions_of(int dimension, const double* positions, std::size_t count) {
  return rows_view(positions, count, static_cast<std::size_t>(dimension), "positions");
}

/// Seeds of the caller in a space of `dimension` coordinates.
inline SeedsView seeds_of(int dimension, const double* positions, const double* weights, std::size_t count) {
  return {dimension, positions_of(dimension, positions, count), optional_view(weights, count)};
}

}  // namespace powercell::c_api
