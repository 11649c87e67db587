/// \file
/// A surface with its layers moved far from each other.
#pragma once

#include <powercell/density.hpp>
#include <vector>

#include "lib/applications/sampling/layers.hpp"

namespace powercell {

/// Each layer is translated along the axis in which the surface is thinnest, as far as it is thick and `gap`
/// more.
class MovedLayers {
 public:
  MovedLayers(const Domain& surface, const Layers& layers, double gap);

  const Domain& domain() const { return moved_; }
  /// The density of the surface, moved with it.
  Density density(const Density& of_surface) const;
  /// Moves points of the moved surface back.
  /// \return the number of points on each layer
  std::vector<std::size_t> move_back(std::vector<double>& positions) const;

 private:
  Domain surface_;
  std::size_t axis_;
  double pitch_;
  std::uint32_t count_;
  std::vector<std::uint32_t> layer_;  // per region of the surface
  Domain moved_;
};

}  // namespace powercell
