/// \file
/// The frame in which devices compute: coordinates scaled by a power of two so that the domain is of
/// size 1, which is exact and keeps every power of a length inside the range of floats.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

struct Frame {
  double scale = 1;                ///< device coordinate = scale * (coordinate - centre)
  std::array<double, 3> centre{};  ///< 0 for double precision, where differences need no shift
  bool split = false;              ///< floats: each number is the sum of a high and a low float

  /// \param float32 coordinates are shifted to the domain's centre and split into two floats
  static Frame of(const RegionMesh& mesh, bool float32);

  double to_device(double x, int axis) const { return scale * (x - centre[static_cast<std::size_t>(axis)]); }
  double weight_to_device(double w) const { return scale * scale * w; }

  /// The largest coordinates and weights, in device units, of which squares and their sums are finite.
  double most_coordinate() const { return split ? 1e17 : 1e140; }
  double most_weight() const { return split ? 1e34 : 1e280; }

  /// Factor from device units to the caller's for a quantity of unit length^power.
  double unit(int power) const { return std::pow(1 / scale, power); }

  /// Bytes of one packed point: 4 doubles, or 4 high and 4 low floats.
  static constexpr std::size_t point_bytes = 32;

  /// Points with weights packed as the kernels' seed_t (kernels/base/real.cl).
  /// \param positions count x dimension   \param weights count, or empty for 0
  std::vector<std::byte> pack(int dimension, std::span<const double> positions,
                              std::span<const double> weights) const;
  /// The same into memory of count x point_bytes bytes.
  void pack_to(std::byte* to, int dimension, std::span<const double> positions,
               std::span<const double> weights, int threads) const;
};

}  // namespace powercell
