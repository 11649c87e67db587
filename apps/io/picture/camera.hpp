/// \file
/// Cameras.
#pragma once

#include <span>

#include "apps/io/picture/vector.hpp"

namespace powercell::io {

/// How a picture shows a model.
struct View {
  Vec3 towards{0.60f, -0.80f, 0.52f};  ///< from the model to the camera
  Vec3 up{0, 0, 1};                    ///< shown upwards; not parallel to `towards`
  int width = 1600, height = 1600;     ///< largest size of the picture in pixels
  bool exact = false;                  ///< it has this size
};

/// A point in a picture: pixels, y downwards; `nearness` is larger nearer to the camera and linear in x and y
/// on a plane.
struct Projected {
  float x = 0, y = 0, nearness = 0;
};

/// A perspective camera that looks at the origin; the nearness of a point is the inverse of its depth.
struct Camera {
  Vec3 right, up, forward, eye;
  float scale = 1;          ///< pixels per unit at depth 1
  float left = 0, top = 0;  ///< pixel of the optical axis
  int width = 0, height = 0;

  Projected project(Vec3 point) const {
    const Vec3 v = point - eye;
    const float inverse = 1 / dot(v, forward);
    return {left + scale * dot(v, right) * inverse, top - scale * dot(v, up) * inverse, inverse};
  }
  /// Direction of sight through a pixel; its component along `forward` is 1.
  Vec3 ray(float x, float y) const {
    return forward + right * ((x - left) / scale) + up * ((top - y) / scale);
  }
  Vec3 unproject(const Projected& at) const { return eye + ray(at.x, at.y) * (1 / at.nearness); }
};

/// The camera of `view` that fits all `points`, within distance 1 of the origin, into the picture with a
/// margin.
Camera fit_camera(const View& view, std::span<const Vec3> points);

}  // namespace powercell::io
