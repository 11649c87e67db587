/// \file
/// Power diagrams on a box whose opposite sides are one. Internal.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <powercell/diagram.hpp>
#include <span>
#include <vector>

namespace powercell {

/// A box of the plane with its opposite sides identified, density 1. Copies of the seeds near the sides are
/// put around it, and the cells of the seeds themselves are taken; that there are enough copies is known from
/// the sum of their areas, or in single precision from how far they reach (mathematics, (34) and (34a)).
class PeriodicDiagram {
 public:
  /// What a seed meets: a copy of `seed`, at `step` from it.
  struct Wall {
    std::uint32_t seed;
    double measure;
    std::array<double, 2> step;
  };

  /// \throw Error unsupported unless the domain is one box of the plane; as Diagram
  PeriodicDiagram(Device device, Domain box, const Options& options);

  /// \param positions n x 2; those outside the box stand for their copies inside
  /// \throw Error as Diagram
  void set_seeds(std::span<const double> positions, std::span<const double> weights);
  void set_weights(std::span<const double> weights);

  /// Of the seeds; centroids are near their positions as given, so they may lie outside the box.
  const Measures& measures();
  /// Rows of walls, by seed; a pair may have several. A seed may meet a copy of itself: these are left out.
  const std::vector<std::uint64_t>& wall_offset();
  const std::vector<Wall>& walls();

  const Domain& box() const { return box_; }
  /// Where the copies inside the box are of positions, n x 2.
  std::vector<double> inside(std::span<const double> positions) const;

 private:
  void compute(bool walls);
  void place_copies();
  bool covers() const;
  bool missing_copies_are_far() const;
  void gather_walls();

  Domain box_;
  std::array<double, 2> low_, size_;
  Diagram diagram_;    // in the box grown by half of itself to each side
  double margin_ = 0;  // copies lie within, as a fraction of the box; 1: all eight neighbours of the box
  std::vector<double> given_, inside_, weights_;
  std::vector<std::uint32_t> original_;        // per seed and copy
  std::vector<std::array<double, 2>> placed_;  // where they are
  bool copies_placed_ = false, weights_set_ = false;
  std::optional<Measures> measures_;
  bool have_walls_ = false;
  std::vector<std::uint64_t> wall_offset_;
  std::vector<Wall> walls_;
};

}  // namespace powercell
