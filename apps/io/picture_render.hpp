/// \file
/// A small renderer: triangles and lines, one soft light, shadows, a white floor.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/io/picture_palette.hpp"
#include "apps/io/picture_vector.hpp"

namespace powercell::io {

/// What is rendered. Coordinates are such that the whole lies within distance 1 of the origin, z up.
struct Model {
  struct Triangle {
    std::array<Vec3, 3> corner;
    std::array<Vec3, 3> normal;  ///< unit, on either side
    Colour colour;
  };
  /// A line on the surface of triangles, seen where they are.
  struct Line {
    Vec3 from, to;
    Colour colour;
    float width;  ///< pixels
  };
  std::vector<Triangle> triangles;
  std::vector<Line> lines;
  bool closed = false;  ///< triangles run counter-clockwise seen from outside and hide their other side
};

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< height x width x 3, row-major, from the top
};

/// Direction from the origin to the camera: from the right front, a little above.
Vec3 view_direction();
/// Whether a plane through `point` with that normal shows its front to the camera.
bool faces_camera(Vec3 point, Vec3 normal);

/// Renders `model` on white, `long_side` pixels wide or high. The same model gives the same pixels.
Image render(const Model& model, int long_side = 1600);

}  // namespace powercell::io
