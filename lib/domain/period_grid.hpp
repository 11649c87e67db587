/// \file
/// The lattice of a periodic domain in integers, with which host and devices wrap seeds alike.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels/layout.h"

namespace powercell {

/// What the lattice is made of.
struct PeriodVectors {
  using Coordinates = std::array<double, 3>;
  int count = 0;  ///< of vectors
  bool is_box = false;
  std::array<Coordinates, 3> vector{}, dual{};
  Coordinates origin{}, quantum{};                        ///< quantum: 0 for coordinates that are not rounded
  std::array<std::array<std::int64_t, 3>, 3> of_given{};  ///< each vector in those given
};

/// Wraps points in whole quanta (docs/mathematics.md (34c)): every step is exact, or an estimate in integers,
/// so that all devices and the host come to the same numbers (kernels/seeds/period.cl).
class PeriodGrid {
 public:
  using Point = std::array<std::int64_t, 3>;  ///< in quanta; 0 for coordinates that are not rounded
  using Numbers = std::array<std::int64_t, PERIOD_SIZE>;

  PeriodGrid() = default;
  explicit PeriodGrid(const PeriodVectors& lattice);

  struct Place {
    Point at{};
    std::array<std::int64_t, 3> shift{};  ///< from there to the point, in the vectors as given
    bool is_far = false;  ///< the point is more than 2^28 vectors away; the rest is then not good
  };
  /// \param x  finite coordinates
  Place wrap(const double* x) const;

  /// The numbers that kernels read (PERIOD_... of kernels/layout.h), without those of a frame.
  const Numbers& numbers() const { return numbers_; }

 private:
  std::int64_t number(int which, std::size_t at = 0) const {
    return numbers_[static_cast<std::size_t>(which) + at];
  }
  std::int64_t fraction(const Point& at, std::size_t k) const;
  Point moved(const Point& at, const std::array<std::int64_t, 3>& by) const;
  std::array<std::int64_t, 3> settle_in_box(Point& at) const;
  std::array<std::int64_t, 3> settle_in_lattice(Point& at) const;

  Numbers numbers_{};
};

}  // namespace powercell
