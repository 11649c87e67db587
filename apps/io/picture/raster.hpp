/// \file
/// Triangles to samples, with a depth buffer.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "apps/io/picture/camera.hpp"

namespace powercell::io {

using ProjectedTriangle = std::array<Projected, 3>;

/// A grid of samples in row-major order; the sample of column 0 and row 0 lies at (0.5, 0.5). Each holds the
/// triangle nearest there.
struct Samples {
  static constexpr std::uint32_t nothing = ~0u;
  static constexpr float farthest = std::numeric_limits<float>::lowest();

  int width, height;
  std::vector<float> nearness;
  std::vector<std::uint32_t> triangle;

  Samples(int width, int height)
      : width(width), height(height), nearness(count(), farthest), triangle(count(), nothing) {}
  std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
  void clear();
  /// Draws triangle `number`; on a tie the one drawn first stays.
  void draw(const ProjectedTriangle& triangle, std::uint32_t number);
};

/// Weights of the corners at a point of a triangle's plane, as affine functions of the point.
struct Barycentric {
  std::array<float, 3> a{}, b{}, c{};  ///< weight k: a[k] x + b[k] y + c[k]
  bool flat;                           ///< the triangle has practically no area in the picture

  explicit Barycentric(const ProjectedTriangle& triangle);
  float operator()(std::size_t k, float x, float y) const { return a[k] * x + b[k] * y + c[k]; }
};

}  // namespace powercell::io
