#include "lib/domain/orientation.hpp"

#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "lib/base/random.hpp"

namespace powercell {
namespace {

int rational_orient2d(const double* a, const double* b, const double* c) {
  using Rational = boost::multiprecision::cpp_rational;
  const Rational area = (Rational(b[0]) - Rational(a[0])) * (Rational(c[1]) - Rational(a[1])) -
                        (Rational(b[1]) - Rational(a[1])) * (Rational(c[0]) - Rational(a[0]));
  return area.sign();
}

TEST_CASE("orient2d equals the rational sign, near and on lines, at any offset") {
  std::mt19937_64 random(3);
  auto real = [&] { return uniform(random) - 0.5; };
  int zeros = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const double offset = trial % 4 == 0 ? 0 : std::ldexp(real(), trial % 60);
    const double a[2] = {offset + real(), offset + real()}, b[2] = {offset + real(), offset + real()};
    const double t = trial % 3 == 0 ? 0.5 : trial % 3 == 1 ? 2.0 : real();
    double c[2] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
    for (int step = trial % 5; step > 2; --step) c[trial % 2] = std::nextafter(c[trial % 2], real() * 1e30);
    const int expected = rational_orient2d(a, b, c);
    zeros += expected == 0;
    REQUIRE(orient2d(a, b, c) == expected);
    REQUIRE(orient2d(b, c, a) == expected);
    REQUIRE(orient2d(b, a, c) == -expected);
  }
  CHECK(zeros > 100);
  CHECK(zeros < 19000);
}

TEST_CASE("orient2d equals the rational sign where products underflow") {
  std::mt19937_64 random(5);
  const auto coordinate = [&](int exponent) { return std::ldexp(double(random() % 9) - 4, exponent); };
  int zeros = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int exponents[] = {-1060, -700, -540, -500, 0, 300};
    const int x = exponents[trial % 6], y = exponents[trial / 6 % 6];
    const double a[2] = {coordinate(x), coordinate(y)}, b[2] = {coordinate(x), coordinate(y)},
                 c[2] = {coordinate(x), coordinate(y)};
    const int expected = rational_orient2d(a, b, c);
    zeros += expected == 0;
    REQUIRE(orient2d(a, b, c) == expected);
    REQUIRE(orient2d(c, b, a) == -expected);
  }
  CHECK(zeros > 100);
  CHECK(zeros < 1000);
  // A rounding error of a difference decides whether a product becomes 0 or the least positive number.
  const double e = 0x1p-52, k = 40265318;
  const double a[2] = {-0.3 * e * 0x1p-537, 0}, b[2] = {(1 - k * e) * 0x1p-537, 0x1p-537},
               c[2] = {(1 - e / 2) * 0x1p-538, (1 + k * e) * 0x1p-538};
  CHECK(rational_orient2d(a, b, c) == -1);
  CHECK(orient2d(a, b, c) == -1);
}

TEST_CASE("strictly_between") {
  const double a[2] = {0, 0}, b[2] = {1, 2}, c[2] = {3, 6}, beside[2] = {1, std::nextafter(2.0, 3)};
  CHECK(strictly_between(a, b, c));
  CHECK(strictly_between(c, b, a));
  CHECK_FALSE(strictly_between(a, c, b));
  CHECK_FALSE(strictly_between(a, a, b));
  CHECK_FALSE(strictly_between(a, b, b));
  CHECK_FALSE(strictly_between(a, beside, c));
  const double up[2] = {0, 2}, middle[2] = {0, 1}, level[2] = {4, 0}, half[2] = {2, 0};
  CHECK(strictly_between(a, middle, up));
  CHECK_FALSE(strictly_between(a, up, middle));
  CHECK(strictly_between(a, half, level));
  CHECK_FALSE(strictly_between(a, middle, level));
}

}  // namespace
}  // namespace powercell
