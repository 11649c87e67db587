#include "lib/domain/orient2d.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace powercell {
namespace {

/// The sign of a sum of 12 doubles: an expansion of non-overlapping terms, grown one by one.
class ExactSum {
 public:
  void add_product(double x, double y) {
    const double product = x * y;
    add(std::fma(x, y, -product));
    add(product);
  }
  int sign() const {
    for (int k = count_ - 1; k >= 0; --k) {
      if (term_[k] != 0) return term_[k] > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  void add(double x) {
    for (int k = 0; k < count_; ++k) {
      const double sum = x + term_[k];
      const double part = sum - x;
      term_[k] = (x - (sum - part)) + (term_[k] - part);  // what rounding `sum` lost
      x = sum;
    }
    term_[count_++] = x;
  }
  std::array<double, 12> term_{};  // in order of growing magnitude
  int count_ = 0;
};

int exact_orient2d(const double* a, const double* b, const double* c) {
  ExactSum sum;  // a×b + b×c + c×a, from the coordinates themselves: differences would round
  sum.add_product(a[0], b[1]);
  sum.add_product(-a[1], b[0]);
  sum.add_product(b[0], c[1]);
  sum.add_product(-b[1], c[0]);
  sum.add_product(c[0], a[1]);
  sum.add_product(-c[1], a[0]);
  return sum.sign();
}

}  // namespace

int orient2d(const double* a, const double* b, const double* c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]);
  const double right = (b[1] - a[1]) * (c[0] - a[0]);
  const double area = left - right;
  // Each product carries three roundings and their difference one more.
  const double bound = 4 * std::numeric_limits<double>::epsilon() * (std::fabs(left) + std::fabs(right));
  if (std::fabs(area) > bound) return area > 0 ? 1 : -1;
  return exact_orient2d(a, b, c);
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

}  // namespace powercell
