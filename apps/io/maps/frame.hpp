/// \file
/// How the plane of a computation lies on the map that its inputs are in.
#pragma once

#include <memory>
#include <string>

#include "apps/io/maps/projection.hpp"
#include "apps/io/tables/read_seeds.hpp"

namespace powercell::io {

struct MapFrame {
  std::string crs;     ///< of the domain's coordinates, as it was named; empty if nothing names one
  std::string member;  ///< JSON of the member `crs` for GeoJSON; empty if it needs none
  /// Null if the plane is that of the domain's coordinates.
  std::shared_ptr<const MapPlane> plane;
};

/// The inputs of a diagram, as far as its files repeat them. Nothing is owned.
struct InputView {
  const SeedTable* table = nullptr;
  const MapFrame* map = nullptr;

  const MapPlane* plane() const { return map != nullptr ? map->plane.get() : nullptr; }
  /// The coordinates of the seeds as they were given.
  const double* positions(const SeedsView& seeds) const {
    return table != nullptr && !table->given.empty() ? table->given.data() : seeds.positions.data();
  }
};

}  // namespace powercell::io
