/// \file
/// Light from many directions, each with a shadow map of its own.
#pragma once

#include <span>
#include <vector>

#include "apps/io/picture/raster.hpp"

namespace powercell::io {

using Triangle = std::array<Vec3, 3>;

/// A point of a surface in a picture.
struct Place {
  Vec3 point, normal;  ///< unit, towards the camera; zero where the pixel shows no surface
  int blur = 0;        ///< pixels on each side whose light is averaged, as far as they lie in its plane
};

/// Shares of the light, from 0 to 1, that reach a place and are not blocked by triangles.
struct Light {
  float sun = 1;  ///< from a small disc
  float sky = 1;  ///< from all directions in front of the surface
};

/// The light at each pixel of a picture. Everything lies within distance 1 of the origin, except places that
/// no triangle shades.
/// \param places  row-major
/// \param sun  unit vector towards it
std::vector<Light> light_on(const std::vector<Place>& places, int width, std::span<const Triangle> triangles,
                            Vec3 sun);

}  // namespace powercell::io
