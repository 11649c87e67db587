#include "lib/update/predicates.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "lib/domain/orientation.hpp"

namespace powercell {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// In units of the sums of the sizes of all products, more than the rounding of the determinants below.
constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();
constexpr double least_sum = 1e-260;  // of sums of sizes whose products did not underflow

/// A corner relative to a site, and its power distance from the site less that of the site.
template <class Number>
struct Row {
  std::array<Number, 3> at;
  Number lift;
};

template <class Number>
Row<Number> row_of(const Site& corner, const Site& site) {
  Row<Number> row;
  row.lift = Number(site[3]) - Number(corner[3]);
  for (std::size_t k = 0; k < 3; ++k) {
    row.at[k] = Number(corner[k]) - Number(site[k]);
    row.lift += row.at[k] * row.at[k];
  }
  return row;
}

/// Whether the sign of a sum is known, given the sum of the sizes of its parts.
bool is_certain(double sum, double size) {
  return size > least_sum && std::fabs(sum) > rounding * size;
}

template <class Number>
Number minor(const std::array<Number, 3>& a, const std::array<Number, 3>& b, std::size_t i, std::size_t j) {
  return a[i] * b[j] - a[j] * b[i];
}
double minor_size(const std::array<double, 3>& a, const std::array<double, 3>& b, std::size_t i,
                  std::size_t j) {
  return std::fabs(a[i] * b[j]) + std::fabs(a[j] * b[i]);
}

/// det(x, y, z), and of its sizes.
template <class Number>
Number triple(const Row<Number>& x, const Row<Number>& y, const Row<Number>& z) {
  return x.at[0] * minor(y.at, z.at, 1, 2) + x.at[1] * minor(y.at, z.at, 2, 0) +
         x.at[2] * minor(y.at, z.at, 0, 1);
}
double triple_size(const Row<double>& x, const Row<double>& y, const Row<double>& z) {
  return std::fabs(x.at[0]) * minor_size(y.at, z.at, 1, 2) +
         std::fabs(x.at[1]) * minor_size(y.at, z.at, 2, 0) +
         std::fabs(x.at[2]) * minor_size(y.at, z.at, 0, 1);
}

double size_of_lift(const Row<double>& row, const Site& corner, const Site& site) {
  return row.at[0] * row.at[0] + row.at[1] * row.at[1] + row.at[2] * row.at[2] +
         std::fabs(site[3] - corner[3]);
}

/// The lift of the plane through the corners at the site, times the simplex's volume.
template <class Number>
Number lifted(const std::array<Row<Number>, 4>& r) {
  return r[0].lift * triple(r[1], r[2], r[3]) - r[1].lift * triple(r[0], r[2], r[3]) +
         r[2].lift * triple(r[0], r[1], r[3]) - r[3].lift * triple(r[0], r[1], r[2]);
}
template <class Number>
Number lifted(const std::array<Row<Number>, 3>& r) {
  return r[0].lift * minor(r[1].at, r[2].at, 0, 1) - r[1].lift * minor(r[0].at, r[2].at, 0, 1) +
         r[2].lift * minor(r[0].at, r[1].at, 0, 1);
}

template <std::size_t corners>
int exact_conflict(const std::array<const Site*, corners>& corner, const Site& site) {
  std::array<Row<Rational>, corners> rows;
  for (std::size_t k = 0; k < corners; ++k) rows[k] = row_of<Rational>(*corner[k], site);
  return lifted(rows).sign();
}

}  // namespace

int orientation(const std::array<const Site*, 4>& corner) {
  return orient3d(corner[0]->data(), corner[1]->data(), corner[2]->data(), corner[3]->data());
}
int orientation(const std::array<const Site*, 3>& corner) {
  return orient2d(corner[0]->data(), corner[1]->data(), corner[2]->data());
}

int conflict_sign(const std::array<const Site*, 4>& corner, const Site& site) {
  std::array<Row<double>, 4> r;
  std::array<double, 4> size;
  for (std::size_t k = 0; k < 4; ++k) {
    r[k] = row_of<double>(*corner[k], site);
    size[k] = size_of_lift(r[k], *corner[k], site);
  }
  const double sum = lifted(r),
               all = size[0] * triple_size(r[1], r[2], r[3]) + size[1] * triple_size(r[0], r[2], r[3]) +
                     size[2] * triple_size(r[0], r[1], r[3]) + size[3] * triple_size(r[0], r[1], r[2]);
  if (is_certain(sum, all)) return sum > 0 ? 1 : -1;
  return exact_conflict(corner, site);
}

int conflict_sign(const std::array<const Site*, 3>& corner, const Site& site) {
  std::array<Row<double>, 3> r;
  double all = 0;
  for (std::size_t k = 0; k < 3; ++k) r[k] = row_of<double>(*corner[k], site);
  for (std::size_t k = 0; k < 3; ++k)
    all += size_of_lift(r[k], *corner[k], site) * minor_size(r[(k + 1) % 3].at, r[(k + 2) % 3].at, 0, 1);
  const double sum = lifted(r);
  if (is_certain(sum, all)) return sum > 0 ? 1 : -1;
  return exact_conflict(corner, site);
}

}  // namespace powercell
