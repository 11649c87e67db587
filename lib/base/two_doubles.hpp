/// \file
/// Numbers as unevaluated sums of two doubles, good to about 104 bits: without fused operations, which not
/// all machines have. Without overflow; results below 10^-290 have an absolute error of some 10^-306.
#pragma once

#include "lib/base/error_free.hpp"

namespace powercell {

/// high + low, high being the nearest double.
struct TwoDoubles {
  double high = 0, low = 0;

  /// Relative errors of results are at most this.
  static constexpr double rounding = 0x1p-102;
};

/// a + b, where |a| >= |b| or a = 0.
inline TwoDoubles joined(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a - b, exactly.
inline TwoDoubles exact_difference(double a, double b) {
  const double difference = a - b;
  return {difference, error_of_sum(a, -b, difference)};
}

inline bool operator<(const TwoDoubles& a, const TwoDoubles& b) {
  return a.high < b.high || (a.high == b.high && a.low < b.low);
}

inline TwoDoubles operator-(const TwoDoubles& a) {
  return {-a.high, -a.low};
}

inline TwoDoubles operator+(const TwoDoubles& a, const TwoDoubles& b) {
  const double high = a.high + b.high, low = a.low + b.low;
  const TwoDoubles sum = joined(high, error_of_sum(a.high, b.high, high) + low);
  return joined(sum.high, sum.low + error_of_sum(a.low, b.low, low));
}

inline TwoDoubles operator-(const TwoDoubles& a, const TwoDoubles& b) {
  return a + -b;
}

inline TwoDoubles operator*(const TwoDoubles& a, const TwoDoubles& b) {
  const double product = a.high * b.high;
  return joined(product, error_of_product(a.high, b.high, product) + (a.high * b.low + a.low * b.high));
}

inline TwoDoubles operator/(const TwoDoubles& a, const TwoDoubles& b) {
  const double first = a.high / b.high;
  const TwoDoubles rest = a - b * TwoDoubles{first, 0};
  const double second = rest.high / b.high;
  const TwoDoubles last = rest - b * TwoDoubles{second, 0};
  const TwoDoubles sum = joined(first, second);
  return joined(sum.high, sum.low + last.high / b.high);
}

}  // namespace powercell
