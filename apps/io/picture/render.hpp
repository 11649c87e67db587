/// \file
/// Shaded pictures of triangles with lines between their parts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/io/picture/camera.hpp"
#include "apps/io/picture/palette.hpp"

namespace powercell::io {

/// Triangles to render, within distance 1 of the origin.
struct Model {
  struct Triangle {
    std::array<Vec3, 3> corner;
    std::array<Vec3, 3> normal;  ///< unit, on either side
    Colour colour;
    std::uint32_t part;  ///< a line is drawn between different parts
    float crease = -1;   ///< and within a part where the cosine of the angle of two normals is below both
  };
  std::vector<Triangle> triangles;
  float line_width = 0;  ///< pixels; 0 for no lines
  double line_ink = 1;   ///< how dark lines are, from 0 (colour of the part) to 1 (ink)
};

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< height x width x 3, row-major, from the top
};

/// Renders `model` on a white floor. The same model gives the same pixels.
Image render(const Model& model, const View& view = {});

}  // namespace powercell::io
