/// \file
/// Triangles and lines to samples, with a depth buffer.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/io/picture_camera.hpp"
#include "apps/io/picture_render.hpp"

namespace powercell::io {

/// A model as a camera sees it.
struct ProjectedModel {
  struct Corner {
    Projected at[3];
  };
  Camera camera;
  std::vector<Corner> triangles;  ///< parallel to Model::triangles
  std::vector<Projected> lines;   ///< two for each of Model::lines
};
ProjectedModel project(const Model& model, const Camera& camera);

/// A strip of rows of a picture, each pixel cut into fine x fine samples, row-major.
struct Strip {
  int width = 0;                     ///< pixels
  int first_row = 0, rows = 0;       ///< pixels
  int fine = 1;                      ///< samples a pixel along each axis
  std::vector<float> inverse_depth;  ///< 0 where nothing is seen
  std::vector<Vec3> normal;          ///< towards the camera or away from it
  std::vector<Colour> colour;

  Strip(int width, int first_row, int rows, int fine);
  std::size_t samples_wide() const { return static_cast<std::size_t>(width * fine); }
};

/// Draws the triangles, then the lines over them.
void rasterize(Strip& strip, const Model& model, const ProjectedModel& projected);

}  // namespace powercell::io
