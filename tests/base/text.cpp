#include "lib/base/text.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <locale>
#include <random>
#include <string>

using namespace powercell;

namespace {

/// Numbers as in "1.234,5".
class Comma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE("digits of a number read back as the same number") {
  std::mt19937_64 random(1);
  for (int k = 0; k < 10000; ++k) {
    const double value = std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 2000) - 1070);
    REQUIRE(std::stod(digits(value)) == value);
    REQUIRE(std::stod(digits(-value, 17)) == -value);
  }
  CHECK(digits(0.1) == "0.1");
  CHECK(digits(-1e-9) == "-1e-09");
  CHECK(digits(std::numeric_limits<double>::denorm_min()) == "5e-324");
  CHECK(digits(std::numeric_limits<double>::lowest()) == "-1.7976931348623157e+308");
  CHECK(digits(std::numeric_limits<double>::infinity()) == "inf");
}

TEST_CASE("digits of a measured number are as many as requested") {
  CHECK(digits(0.0123456, 3) == "0.0123");
  CHECK(digits(1234567, 2) == "1.2e+06");
  CHECK(digits(2, 6) == "2");
}

TEST_CASE("digits are the same in every locale") {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const std::string shortest = digits(1234567.5), some = digits(1234567.5, 10);
  std::locale::global(before);
  CHECK(shortest == "1234567.5");
  CHECK(some == "1234567.5");
}
