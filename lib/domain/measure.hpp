/// \file
/// Measures of simplices and sums of many of them, in `long double` from differences of coordinates,
/// so that neither a far origin nor a million regions cost digits.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// Neumaier's compensated sum.
class CompensatedSum {
 public:
  void add(long double term) {
    const long double next = sum_ + term;
    const bool sum_larger = std::fabs(sum_) >= std::fabs(term);
    lost_ += sum_larger ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  double value() const { return static_cast<double>(sum_ + lost_); }

 private:
  long double sum_ = 0, lost_ = 0;
};

using Vector = std::array<long double, 3>;

inline Vector difference(const double* a, const double* b) {
  return {static_cast<long double>(a[0]) - b[0], static_cast<long double>(a[1]) - b[1],
          static_cast<long double>(a[2]) - b[2]};
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline long double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A triangle or tetrahedron is flat when its least height is at most this fraction of its longest
/// edge: four units in the last place, about what rounding its vertices can make of a true zero.
inline constexpr long double flat_ratio = 0x1p-50L;

/// Sets the bounding box from the vertices that regions use, and checks that coordinates and measure are of
/// a size to compute with. \throw Error invalid_domain
void finish(RegionMesh& mesh, const CompensatedSum& measure);

}  // namespace powercell
