/// \file
/// Coordinates in which a surface has a diagonal between 1/2 and 1 and its centre at the origin.
#pragma once

#include <span>
#include <vector>

#include "lib/remeshing/vec.hpp"

namespace powercell::remeshing {

struct Frame {
  Vec centre;
  double length = 1;  ///< the unit, a power of two

  std::vector<double> to(std::span<const double> vertices) const;
  Vec back(Vec x) const { return x * length + centre; }
};

/// Of the bounding box of the vertices, those that are not finite left out.
Frame frame_of(std::span<const double> vertices);

}  // namespace powercell::remeshing
