#include "lib/base/error_free.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace powercell;

namespace {

template <class T>
void check_against_fma() {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> fraction(1, 2);
  std::uniform_int_distribution<int> exponent(-40, 40);
  const auto number = [&] {
    return static_cast<T>(std::ldexp(engine() % 2 ? fraction(engine) : -fraction(engine), exponent(engine)));
  };
  int differ = 0;
  for (int k = 0; k < 300000; ++k) {
    const T a = number(), b = number();
    for (const T c : {number(), static_cast<T>(-(a * b)), static_cast<T>(a * b * 0x1p-24), T{0}})
      differ += rounded_once(a, b, c) != std::fma(a, b, c);
  }
  CHECK(differ == 0);
}

}  // namespace

// std::fma of the C libraries of Linux and macOS; that of MinGW-w64 rounds twice.
TEST_CASE("products and sums are rounded once as by std::fma") {
  check_against_fma<float>();
  check_against_fma<double>();
}

TEST_CASE("a product and its error are the whole product") {
  std::mt19937_64 engine(1);
  int differ = 0;
  for (int k = 0; k < 100000; ++k) {
    const double x = static_cast<double>(engine() >> 11), y = -static_cast<double>(engine() >> 11);
    differ += error_of_product(x, y, x * y) != std::fma(x, y, -(x * y));
  }
  CHECK(differ == 0);
}
