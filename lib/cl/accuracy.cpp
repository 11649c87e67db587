#include "lib/cl/accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <limits>
#include <sstream>

#include "lib/base/compiler.hpp"
#include "lib/base/random.hpp"
#include "lib/cl/self_test.hpp"

namespace powercell::cl {

namespace {

template <class T>
constexpr int digits = std::numeric_limits<T>::digits;
template <class T>
constexpr T epsilon = std::numeric_limits<T>::epsilon();
/// Powers of two within REAL_LEAST and its inverse.
template <class T>
constexpr int most_exponent = sizeof(T) == 8 ? 960 : 98;

/// In [1, 2).
template <class T>
T fraction(std::uint64_t bits) {
  return 1 + epsilon<T> * static_cast<T>(bits >> (64 - (digits<T> - 1)));
}

/// A power of two of at most `most` either way.
template <class T>
T scaled(T number, std::uint64_t bits, int most) {
  return std::ldexp(number, static_cast<int>(bits % (2u * static_cast<unsigned>(most) + 1)) - most);
}

struct Integers {
  std::uint64_t a, b;
};

/// Integers of p digits with a / b = (y - r / b) / 2^(p+1), where y is odd, of p + 1 digits, and so just
/// between two numbers of p digits, and r is 1 or -1.
Integers next_to_tie(int p, std::uint64_t bits) {
  const std::uint64_t b = bits >> (64 - p) | std::uint64_t{1} << (p - 1) | 1;
  const std::uint64_t period = std::uint64_t{2} << p;
  std::uint64_t inverse = b;  // of b modulo 2^64; each step doubles its digits
  for (int step = 0; step < 6; ++step) inverse *= 2 - b * inverse;
  const std::uint64_t y = inverse % period;
  const bool negative = y < period / 2;  // -y has the digits that y lacks
  const UnsignedInt128 product = UnsignedInt128{negative ? period - y : y} * b;
  return {static_cast<std::uint64_t>((negative ? product + 1 : product - 1) >> (p + 1)), b};
}

template <class T>
std::array<T, 2> operands_of(std::uint32_t i) {
  const std::uint64_t bits = mixed_bits(4 * i), more = mixed_bits(4 * i + 1), sizes = mixed_bits(4 * i + 2),
                      others = mixed_bits(4 * i + 3);
  const T a = fraction<T>(bits), b = fraction<T>(more);
  switch (i % 8) {
    case 0:
    case 1:  // an integer of p + 1 digits is 1/2 from the numbers next to it
    {
      const Integers hard = next_to_tie(digits<T>, bits);
      return {static_cast<T>(hard.a), static_cast<T>(hard.b)};
    }
    case 2:  // sqrt(1 + k e) = 1 + k e / 2 - (k e)^2 / 8 - ..., a tie for odd k but for the square
      return {a, 1 + epsilon<T> * static_cast<T>(2 * (more % 64) + 1)};
    case 3:
      return {a, std::ldexp(1 - epsilon<T> / 2 * static_cast<T>(2 * (more % 64) + 1),
                            2 * static_cast<int>(sizes % 8))};
    case 4:
    case 5:
      return {scaled(a, sizes, most_exponent<T> / 2), scaled(b, others, most_exponent<T> / 2)};
    case 6:  // less than the least normal number
      return {std::ldexp(a, std::numeric_limits<T>::min_exponent + 4), std::ldexp(b, 8 + i % 16)};
    default:
      return {i % 16 < 8 ? -a : a, b};
  }
}

/// One result into the worst of its kind. `exact` has more digits, where the host has more.
template <class T>
void note(WorstResult& worst, bool& flushes, T a, T b, T got, long double exact) {
  const T right = static_cast<T>(exact);
  const T least = std::numeric_limits<T>::min();
  if (std::abs(right) < least && std::abs(got) <= least) {  // far below REAL_LEAST: errors of the data
    flushes = flushes || (got == 0 && right != 0);
    return;
  }
  const int exponent = std::ilogb(right);
  const long double off = std::abs(static_cast<long double>(got) - exact);
  const bool lost = !std::isfinite(got) || (got == 0 && right != 0);
  const double units = lost ? std::numeric_limits<double>::infinity()
                            : static_cast<double>(std::ldexp(off, digits<T> - 1 - exponent));
  if (units > worst.units) worst = {units, a, b, got, right};
}

std::string in_units(double units) {
  std::ostringstream text;
  text << std::setprecision(3) << units;
  return text.str();
}

/// Why double precision of this accuracy may be an emulation.
std::string emulation(const WorstResult& worst) {
  const double size = std::abs(worst.right);
  constexpr double like_float = 0x1p20;  // a float is off by 2^28
  if (std::isinf(worst.units) &&
      (size > std::numeric_limits<float>::max() || size < std::numeric_limits<float>::min()))
    return "; it keeps no numbers beyond the range of single precision, so its double precision is emulated "
           "by floats";
  if (worst.units >= like_float) return "; it divides or takes roots in little more than single precision";
  return "; its double precision may be emulated";
}

std::string fault_of(const char* what, const WorstResult& worst, double most, bool is_double) {
  if (worst.units <= most) return {};
  std::ostringstream text;
  text << std::setprecision(is_double ? 17 : 9) << what << " in " << (is_double ? "double" : "float")
       << " for a = " << worst.a << ", b = " << worst.b << " gives " << worst.got << ", not " << worst.right;
  if (std::isfinite(worst.units))
    text << ", off by " << in_units(worst.units)
         << " units in the last place, of which the proofs of cells allow " << most;
  return text.str() + (is_double ? emulation(worst) : "");
}

}  // namespace

template <class T>
std::vector<T> accuracy_operands() {
  std::vector<T> operands;
  for (std::uint32_t i = 0; i < accuracy_items; ++i) {
    const auto [a, b] = operands_of<T>(i);
    operands.insert(operands.end(), {a, b, T(0)});
  }
  return operands;
}

template <class T>
Accuracy measure_accuracy(std::span<const T> operands, std::span<const T> results) {
  Accuracy accuracy;
  for (std::size_t i = 0; i < operands.size() / 3; ++i) {
    const T a = operands[3 * i], b = operands[3 * i + 1];
    const T* got = &results[arithmetic_results * i];
    note(accuracy.quotient, accuracy.flushes, a, b, got[2], static_cast<long double>(a) / b);
    note(accuracy.root, accuracy.flushes, a, b, got[3], std::sqrt(static_cast<long double>(b)));
    note(accuracy.reciprocal, accuracy.flushes, a, b, got[6], 1.0L / b);
  }
  return accuracy;
}

std::string accuracy_fault(const Accuracy& accuracy, bool is_double) {
  std::string fault = fault_of("a / b", accuracy.quotient, most_quotient_error, is_double);
  if (fault.empty()) fault = fault_of("1 / b", accuracy.reciprocal, most_quotient_error, is_double);
  if (fault.empty()) fault = fault_of("sqrt(b)", accuracy.root, most_root_error, is_double);
  return fault;
}

std::string describe(const Accuracy& accuracy, bool is_double) {
  return std::string(is_double ? "double" : "float") + ": quotients off by up to " +
         in_units(std::max(accuracy.quotient.units, accuracy.reciprocal.units)) + ", roots by " +
         in_units(accuracy.root.units) + " units in the last place, subnormal results " +
         (accuracy.flushes ? "flushed to 0" : "kept");
}

template std::vector<float> accuracy_operands();
template std::vector<double> accuracy_operands();
template Accuracy measure_accuracy(std::span<const float>, std::span<const float>);
template Accuracy measure_accuracy(std::span<const double>, std::span<const double>);

namespace {

// Operands are read from volatile memory, so that nothing is computed by the compiler.
template <class T>
T hidden(T value) {
  volatile T stored = value;
  return stored;
}

template <class T>
struct Probe {
  static constexpr T one = 1, unit = std::numeric_limits<T>::epsilon();

  /// (1 + u/4) - 1 is 0 in floating-point numbers, and u/4 after reassociation.
  static bool sums_in_order() {
    const T a = hidden(one), b = hidden(unit / 4);
    return (a + b) - a == 0;
  }

  /// A sum over an array, which a compiler may add up in several parts at a time.
  static bool loops_in_order() {
    std::array<T, 64> terms;
    for (std::size_t k = 0; k < terms.size(); ++k)
      terms[k] = hidden(k == 0 ? 1 / unit : k + 1 == terms.size() ? -1 / unit : one / 4);
    T sum = 0;
    for (const T term : terms) sum += term;
    return sum == 0;
  }

  /// (1 + u)(1 - u) - 1 is 0 if the product is rounded, and -u^2 if it is fused with the difference.
  static bool rounds_products() {
    const T a = hidden(one + unit), b = hidden(one - unit), c = hidden(one);
    return a * b - c == 0;
  }

  static constexpr std::array<T, 100> quotients() {
    std::array<T, 100> all{};
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<T>(k) / 49;
    return all;
  }

  /// Against the compiler's own division: k (1/49) differs from k/49 for some k.
  static bool divides() {
    static constexpr std::array<T, 100> right = quotients();
    const T divisor = hidden(T{49});
    bool same = true;
    for (std::size_t k = 0; k < right.size(); ++k) same = same && static_cast<T>(k) / divisor == right[k];
    return same;
  }

  static bool knows_what_is_no_number() {
    const T none = hidden(std::numeric_limits<T>::quiet_NaN()), most = hidden(std::numeric_limits<T>::max());
    return none != none && most * 2 > most;
  }

  static bool keeps_subnormals() {
    return hidden(std::numeric_limits<T>::min()) / 2 != 0 &&
           hidden(std::numeric_limits<T>::denorm_min()) * 2 != 0;
  }

  static const char* fault() {
    if (!sums_in_order()) return "(1 + u/4) - 1 is not 0, with u the unit in the last place of 1";
    if (!loops_in_order()) return "a sum is not taken in its order";
    if (!rounds_products()) return "(1 + u)(1 - u) - 1 is not 0, with u the unit in the last place of 1";
    if (!divides()) return "k / 49 is not rounded correctly";
    if (!knows_what_is_no_number()) return "NaN is equal to itself, or infinity to the largest number";
    if (!keeps_subnormals()) return "the least numbers are flushed to 0";
    return nullptr;
  }
};

}  // namespace

std::string host_arithmetic_fault() {
  for (const char* fault : {Probe<double>::fault(), Probe<float>::fault()})
    if (fault) return fault;
  return {};
}

}  // namespace powercell::cl
