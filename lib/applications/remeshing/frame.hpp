/// \file
/// Normalised coordinates, in which a surface has a diagonal between 1/2 and 1 and its centre at the origin.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/applications/remeshing/vec.hpp"

namespace powercell::remeshing {

struct Frame {
  Vec centre;
  double length = 1;  ///< the unit, a power of two so that scaling is exact

  std::vector<double> to(std::span<const double> vertices) const;
  Vec back(Vec x) const { return x * length + centre; }
};

/// The frame of the bounding box of the vertices that triangles use.
/// \pre check_triangles passed
Frame frame_of(std::span<const double> vertices, std::span<const std::uint32_t> triangles);

}  // namespace powercell::remeshing
