#include "lib/domain/exact_orientation.hpp"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>

namespace powercell {

int exact_orientation(std::span<const double> positions, std::span<const std::uint32_t> corners) {
  using Rational = boost::multiprecision::cpp_rational;
  const std::size_t d = corners.size() - 1;
  std::array<std::array<Rational, 3>, 3> e;
  for (std::size_t r = 0; r < d; ++r)
    for (std::size_t k = 0; k < d; ++k)
      e[r][k] = Rational(positions[d * corners[r + 1] + k]) - Rational(positions[d * corners[0] + k]);
  const auto minor = [&](std::size_t a, std::size_t b) {
    return Rational(e[0][a] * e[1][b] - e[0][b] * e[1][a]);
  };
  if (d == 2) return minor(0, 1).sign();
  return Rational(e[2][0] * minor(1, 2) - e[2][1] * minor(0, 2) + e[2][2] * minor(0, 1)).sign();
}

}  // namespace powercell
