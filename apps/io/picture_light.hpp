/// \file
/// Light that does not depend on a sample's own normal: what is near and what stands in the way.
#pragma once

#include <vector>

#include "apps/io/picture_raster.hpp"

namespace powercell::io {

/// Direction from the model to the light.
Vec3 light_direction(const Camera& camera);

/// How much of the light reaches a point past the model: a depth map seen from the light.
class Shadow {
 public:
  Shadow(const Model& model, Vec3 to_light);
  /// From 0 (dark) to 1, averaged over a disc of `radius` (model units) around the point.
  float lit(Vec3 point, Vec3 normal, float radius, unsigned pattern) const;
  /// The same for a point below all of the model, very softly.
  float lit_below(Vec3 point) const;

 private:
  void soften();

  Vec3 right_, up_, to_light_;
  int size_ = 2048;
  std::vector<float> height_;  // along to_light_, per texel; very low where nothing is
  std::vector<float> cover_;   // share covered, blurred, on a coarser and wider grid
  float nearest(float u, float v) const;
};

/// For each pixel of `strip` (fine = 1, the whole picture): the share of the sky that near parts of the
/// model leave open, from 0 to 1, smoothed.
std::vector<float> open_sky(const Strip& picture, const Camera& camera);

}  // namespace powercell::io
