/// \file
/// The frame in which devices compute: coordinates are scaled by a power of two, which is exact, so that the
/// domain has size 1 and powers of lengths stay in the range of floats.
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
  std::array<double, 3> centre{};  ///< 0 in double precision, where differences need no shift
  bool split = false;              ///< single precision: each number is the sum of a high and a low float

  /// \param float32 single precision: shift coordinates to the domain's centre and split them into two floats
  static Frame of(const RegionMesh& mesh, bool float32);

  double to_device(double x, int axis) const { return scale * (x - centre[static_cast<std::size_t>(axis)]); }
  double weight_to_device(double w) const { return scale * scale * w; }

  /// The largest coordinates and weights, in device units, whose squares and sums of squares are finite.
  double most_coordinate() const { return split ? 1e17 : 1e140; }
  double most_weight() const { return split ? 1e34 : 1e280; }

  /// Factor that converts a quantity of dimension length^power from device units to the caller's.
  double unit(int power) const { return std::pow(1 / scale, power); }

  /// Bytes of one packed point: 4 doubles, or 4 high and 4 low floats.
  static constexpr std::size_t point_bytes = 32;

  /// Points with weights packed as the kernels' seed_t (kernels/base/real.cl).
  /// \param positions count x dimension
  /// \param weights count, or empty for 0
  std::vector<std::byte> pack(int dimension, std::span<const double> positions,
                              std::span<const double> weights) const;
  /// The same, into `to`, which has room for count x point_bytes bytes.
  void pack_to(std::byte* to, int dimension, std::span<const double> positions,
               std::span<const double> weights, int threads) const;
};

}  // namespace powercell
