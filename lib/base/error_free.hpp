/// \file
/// What rounding takes from products and sums, by additions and multiplications alone: std::fma rounds twice
/// in some standard libraries (MinGW's). Without underflow and overflow.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace powercell {

/// x + y - sum, where `sum` is the rounded x + y (Knuth).
inline double error_of_sum(double x, double y, double sum) {
  const double part = sum - x;
  return (x - (sum - part)) + (y - part);
}

/// x * y - product, where `product` is the rounded x * y (Dekker). Factors are below 2^996.
inline double error_of_product(double x, double y, double product) {
  const auto upper_half = [](double z) {
    const double scaled = 134217729 * z;  // 2^27 + 1
    return scaled - (scaled - z);
  };
  const double x1 = upper_half(x), x2 = x - x1, y1 = upper_half(y), y2 = y - y1;
  return x2 * y2 - (((product - x1 * y1) - x2 * y1) - x1 * y2);
}

/// x + y, of the two numbers beside it the one with an odd last bit: rounding it again is like rounding once.
inline double odd_sum(double x, double y) {
  const double sum = x + y, lost = error_of_sum(x, y, sum);
  if (lost == 0 || std::bit_cast<std::uint64_t>(sum) % 2 == 1) return sum;
  return std::nextafter(sum, lost > 0 ? HUGE_VAL : -HUGE_VAL);
}

/// a * b + c, rounded once (Boldo and Melquiond).
template <class T>
T rounded_once(T a, T b, T c) {
  const double product = static_cast<double>(a) * b;
  if constexpr (std::is_same_v<T, float>) {
    return static_cast<float>(odd_sum(product, c));  // the product is exact
  } else {
    const double lost = error_of_product(a, b, product);
    const double low = c + lost, high = product + low;
    return high + odd_sum(error_of_sum(c, lost, low), error_of_sum(product, low, high));
  }
}

}  // namespace powercell
