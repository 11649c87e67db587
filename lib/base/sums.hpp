/// \file
/// Sums of many terms.
#pragma once

#include <cmath>
#include <concepts>

namespace powercell {

/// Neumaier's compensated sum: the rounding error of each addition is accumulated separately, so a million
/// terms lose no more digits than one.
template <std::floating_point T>
class CompensatedSum {
 public:
  void add(T term) {
    const T next = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  double value() const { return static_cast<double>(sum_ + lost_); }

 private:
  T sum_ = 0, lost_ = 0;
};

}  // namespace powercell
