/// \file
/// The translations under which a periodic domain repeats (docs/mathematics.md, "Periodic domains").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lib/domain/period_grid.hpp"

namespace powercell {

/// A combination of translations with integer factors.
using Shift = std::array<std::int32_t, 3>;

inline Shift opposite(const Shift& shift) {
  return {-shift[0], -shift[1], -shift[2]};
}

/// The lattice of a periodic domain. Distances are computed with the vectors of a reduced basis, whose
/// coordinates are multiples of `quantum`, as are those of wrapped seeds: all images of a seed that can
/// matter are then doubles without rounding.
class Period {
 public:
  using Coordinates = std::array<double, 3>;

  /// Of a box with periodic axes: the vectors are its edges along these.
  /// \throw Error invalid_domain
  static Period of_box(std::span<const double> low, std::span<const double> high, std::array<bool, 3> axes);
  /// Of `dimension` vectors from the corner `origin`.
  /// \throw Error invalid_domain (dependent vectors, or lengths of the reduced basis 10^6 times apart)
  static Period of_lattice(std::span<const double> vectors, std::span<const double> origin);

  int dimension() const { return dimension_; }
  int count() const { return count_; }                               ///< of the vectors of the reduced basis
  const Coordinates& vector(int k) const { return vector_[at(k)]; }  ///< of the reduced basis
  double spacing(int k) const { return spacing_[at(k)]; }  ///< between planes of the lattice along vector k
  /// Seeds whose difference has a larger fraction() along vector k share no wall.
  double reach(int k) const { return reach_[at(k)]; }
  double measure() const { return measure_; }                       ///< of a box or of a cell of the lattice
  bool is_periodic(int axis) const { return periodic_[at(axis)]; }  ///< along vector `axis` as given
  const Coordinates& given(int axis) const { return given_[at(axis)]; }  ///< the vectors as given
  /// The box that contains every cell of a wrapped seed, in its periodic directions with room to spare.
  const Coordinates& room_low() const { return room_low_; }
  const Coordinates& room_high() const { return room_high_; }

  /// The coordinates of a point in the reduced basis, from the origin.
  Coordinates fraction(const double* x) const;
  /// `x` moved by a shift in the reduced basis: exact for wrapped seeds and images that can matter.
  Coordinates moved(const double* x, const Shift& shift) const;
  /// A shift in the reduced basis as one in the vectors as given.
  std::array<std::int64_t, 3> as_given(const Shift& shift) const;
  /// The sum of a shift in the vectors as given.
  Coordinates sum_given(const Shift& shift) const;

  struct Wrapped {
    Coordinates position;  ///< with fractions from 0 to below 1, but for rounding
    Shift shift;           ///< from there to the point, in the vectors as given
    bool is_far;           ///< the point is more than 2^28 vectors away; the rest is then not good
  };
  Wrapped wrap(const double* x) const;
  /// The same in integers, for devices.
  const PeriodGrid& grid() const { return grid_; }
  const Coordinates& quantum() const { return quantum_; }  ///< 0 for coordinates that are not rounded

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }
  void set_grid();
  void set_quanta();
  void set_room();
  void set_dual();
  void set_reach();

  int dimension_ = 0, count_ = 0;
  bool is_box_ = false;
  std::array<bool, 3> periodic_{}, rounded_{};  ///< by vector as given; by coordinate
  std::array<Coordinates, 3> given_{}, vector_{}, dual_{};
  std::array<std::array<std::int64_t, 3>, 3> of_given_{};  ///< per vector of the reduced basis
  Coordinates origin_{}, quantum_{}, spacing_{}, reach_{}, room_low_{}, room_high_{};
  double measure_ = 0;
  PeriodGrid grid_;
};

/// Wraps points.
/// \param positions  rows of coordinates
/// \param wrapped  as long, receives Wrapped::position; may be the same
/// \param shift  empty, or one a point, receives Wrapped::shift
/// \return the first point with Wrapped::is_far, where the rest is not good, or the number of points
std::size_t wrap_all(const Period& period, std::span<const double> positions, int threads,
                     std::span<double> wrapped, std::span<Shift> shift = {});

/// What is wrong with a seed whose Wrapped::is_far.
inline constexpr const char* too_far_outside =
    "it is more than 2^28 periods outside the periodic domain, where its position is too coarse; move it "
    "by a multiple of the period";
/// \throw Error invalid_seed
[[noreturn]] void refuse_far(std::size_t index);

}  // namespace powercell
