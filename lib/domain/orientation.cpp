#include "lib/domain/orientation.hpp"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "lib/base/error_free.hpp"

namespace powercell {
namespace {

/// Products of at least this magnitude, and their rounding errors, do not underflow.
constexpr double least_product = 1e-280;

/// The exact sign of a sum of 12 doubles: an expansion of non-overlapping terms that grows by one term a
/// double.
class ExactSum {
 public:
  void add_product(double x, double y) {
    const double product = x * y;
    exact_ = exact_ && (x == 0 || y == 0 || std::fabs(product) > least_product);
    add(error_of_product(x, y, product));
    add(product);
  }
  int sign() const {
    for (int k = count_ - 1; k >= 0; --k) {
      if (term_[k] != 0) return term_[k] > 0 ? 1 : -1;
    }
    return 0;
  }
  /// False if the rounding error of a product may have been too small for a double.
  bool exact() const { return exact_; }

 private:
  void add(double x) {
    for (int k = 0; k < count_; ++k) {
      const double sum = x + term_[k];
      term_[k] = error_of_sum(x, term_[k], sum);
      x = sum;
    }
    term_[count_++] = x;
  }
  std::array<double, 12> term_{};  // in order of growing magnitude
  int count_ = 0;
  bool exact_ = true;
};

int exact_orient2d(const double* a, const double* b, const double* c) {
  ExactSum sum;  // a×b + b×c + c×a, from the coordinates, since differences would round
  sum.add_product(a[0], b[1]);
  sum.add_product(-a[1], b[0]);
  sum.add_product(b[0], c[1]);
  sum.add_product(-b[1], c[0]);
  sum.add_product(c[0], a[1]);
  sum.add_product(-c[1], a[0]);
  if (sum.exact()) return sum.sign();
  constexpr std::array<std::uint32_t, 3> corners{0, 1, 2};
  return exact_orientation(std::array{a[0], a[1], b[0], b[1], c[0], c[1]}, corners);
}

}  // namespace

int orient2d(const double* a, const double* b, const double* c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]);
  const double right = (b[1] - a[1]) * (c[0] - a[0]);
  const double area = left - right;
  // Each product carries three roundings and their difference one more.
  const double size = std::fabs(left) + std::fabs(right);
  if (size > least_product && std::fabs(area) > 4 * std::numeric_limits<double>::epsilon() * size)
    return area > 0 ? 1 : -1;
  return exact_orient2d(a, b, c);
}

int orient3d(const double* a, const double* b, const double* c, const double* d) {
  std::array<double, 3> x, y, z;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = b[k] - a[k];
    y[k] = c[k] - a[k];
    z[k] = d[k] - a[k];
  }
  double sum = 0, size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double left = y[i] * z[j], right = y[j] * z[i];
    sum += x[k] * (left - right);
    size += std::fabs(x[k]) * (std::fabs(left) + std::fabs(right));
  }
  if (size > least_product && std::fabs(sum) > 16 * std::numeric_limits<double>::epsilon() * size)
    return sum > 0 ? 1 : -1;
  std::array<double, 12> positions;
  for (std::size_t k = 0; k < 3; ++k) {
    positions[k] = a[k];
    positions[3 + k] = b[k];
    positions[6 + k] = c[k];
    positions[9 + k] = d[k];
  }
  constexpr std::array<std::uint32_t, 4> corners{0, 1, 2, 3};
  return exact_orientation(positions, corners);
}

bool strictly_between(const double* a, const double* b, const double* c) {
  for (int k = 0; k < 2; ++k) {
    if (a[k] == c[k] ? b[k] != a[k] : (b[k] <= a[k]) == (b[k] <= c[k]) && b[k] != a[k] && b[k] != c[k]) {
      return false;
    }
  }
  auto equal = [](const double* p, const double* q) { return p[0] == q[0] && p[1] == q[1]; };
  return !equal(a, b) && !equal(b, c) && orient2d(a, b, c) == 0;
}

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
