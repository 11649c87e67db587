/// \file
/// Power diagrams on a periodic box. Internal.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <powercell/diagram.hpp>
#include <span>
#include <vector>

namespace powercell {

/// The power diagram of seeds in a box of the plane with its opposite sides identified, density 1. Adds
/// copies of the seeds near the sides in a margin around the box and takes the cells of the original seeds.
/// The margin is doubled until there are enough copies: in double precision by the sum of the areas, (34), in
/// single precision by the extent of each cell, (34a). Not thread-safe.
class PeriodicDiagram {
 public:
  /// A wall between a seed and a copy of `seed`.
  struct Wall {
    std::uint32_t seed;
    double measure;
    std::array<double, 2> step;  ///< from the first seed to the copy
  };

  /// \throw Error unsupported unless the domain is a single box of the plane; as Diagram
  PeriodicDiagram(Device device, Domain box, const Options& options);

  /// \param positions  n x 2; those outside the box stand for their copies inside
  /// \param weights    n, or empty for 0
  /// \throw Error invalid_argument (sizes); as Diagram
  void set_seeds(std::span<const double> positions, std::span<const double> weights);
  void set_weights(std::span<const double> weights);

  /// Measures of the n cells. The centroids are near the positions as given, so they may lie outside the box.
  const Measures& measures();
  /// Walls of seed i: [wall_offset()[i], wall_offset()[i+1]) of walls(). A pair of seeds may share several
  /// walls. Walls between a seed and a copy of itself are left out.
  const std::vector<std::uint64_t>& wall_offset();
  const std::vector<Wall>& walls();

  const Domain& box() const { return box_; }
  /// The copies of positions inside the box, n x 2.
  std::vector<double> inside(std::span<const double> positions) const;

 private:
  void compute(bool walls);
  void place_copies();
  bool has_enough_copies() const;
  bool missing_copies_are_far() const;
  void gather_walls();

  Domain box_;
  std::array<double, 2> low_, size_;
  Diagram diagram_;    // in the box extended by half its size to each side
  double margin_ = 0;  // width of the margin as a fraction of the box; 1: all eight copies of each seed
  std::vector<double> given_, inside_, weights_;
  std::vector<std::uint32_t> original_;        // per seed and copy: the seed
  std::vector<std::array<double, 2>> placed_;  // per seed and copy: the position
  bool copies_placed_ = false, weights_set_ = false;
  std::optional<Measures> measures_;
  bool have_walls_ = false;
  std::vector<std::uint64_t> wall_offset_;
  std::vector<Wall> walls_;
};

}  // namespace powercell
