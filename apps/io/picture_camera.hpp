/// \file
/// Perspective and parallel views of a model.
#pragma once

#include <vector>

#include "apps/io/picture_vector.hpp"

namespace powercell::io {

/// A point in a picture: pixels, y downwards, and the inverse of its distance along the view.
struct Projected {
  float x = 0, y = 0, inverse_depth = 0;
};

/// A camera that looks at the origin.
struct Camera {
  Vec3 right, up, forward, eye;
  float scale = 1;          ///< pixels per unit at distance 1
  float left = 0, top = 0;  ///< pixel of the optical axis
  int width = 0, height = 0;

  Projected project(Vec3 point) const {
    const Vec3 v = point - eye;
    const float inverse = 1 / dot(v, forward);
    return {left + scale * dot(v, right) * inverse, top - scale * dot(v, up) * inverse, inverse};
  }
  /// The point seen at a pixel at a given inverse distance.
  Vec3 unproject(float x, float y, float inverse_depth) const {
    return eye + ray(x, y) * (1 / inverse_depth);
  }
  /// Direction of sight through a pixel; its part along `forward` is 1.
  Vec3 ray(float x, float y) const {
    return forward + right * ((x - left) / scale) + up * ((top - y) / scale);
  }
};

/// Distance of cameras from the origin: a gentle perspective of a model of radius 1.
constexpr float camera_distance = 4.5f;

/// A camera in direction `view` from the origin such that all `points` fill a picture whose longer
/// side is `long_side` pixels, with a margin.
Camera fit_camera(Vec3 view, const std::vector<Vec3>& points, int long_side);

}  // namespace powercell::io
