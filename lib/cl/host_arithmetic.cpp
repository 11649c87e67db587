#include "lib/cl/host_arithmetic.hpp"

#include <array>
#include <cstddef>
#include <limits>

namespace powercell::cl {
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
