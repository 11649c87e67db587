/// \file
/// Normals of a triangle mesh for smooth shading.
#pragma once

#include <array>
#include <powercell/regions.hpp>
#include <vector>

#include "apps/io/picture/vector.hpp"

namespace powercell::io {

/// Maps the domain into the ball of radius 1 about the origin.
struct Normalization {
  double centre[3] = {0, 0, 0};
  double scale = 1;
  Vec3 operator()(const double* point) const {
    return {static_cast<float>((point[0] - centre[0]) * scale),
            static_cast<float>((point[1] - centre[1]) * scale),
            static_cast<float>((point[2] - centre[2]) * scale)};
  }
};
Normalization normalization(const Domain& domain);

/// Three normals for each triangle: means over the triangles around a corner that meet it at a small angle,
/// so that creases stay sharp. Corners at the same position count as one, and neighbours may have either
/// orientation.
std::vector<Vec3> corner_normals(const RegionsView& mesh, const Normalization& normalize);

/// The unit normals within one triangle, between those of its corners.
class TriangleNormals {
 public:
  /// \param normals  corner_normals of the mesh
  TriangleNormals(const RegionsView& mesh, const std::vector<Vec3>& normals, const Normalization& normalize,
                  std::uint32_t triangle);
  /// At a point in the triangle's plane, as normalized.
  Vec3 operator()(Vec3 point) const;

 private:
  std::array<Vec3, 3> corner_, normal_;
};

}  // namespace powercell::io
