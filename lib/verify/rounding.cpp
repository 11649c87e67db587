#include "lib/verify/rounding.hpp"

#include <algorithm>
#include <cmath>

namespace powercell {
namespace {

/// Roundings that add up in a plane, from the dot products of a cut and the interpolation of its vertices.
constexpr double roundings = 64;

}  // namespace

double Extent::longest() const {
  double edge = 0;
  for (std::size_t k = 0; k < 3; ++k) edge = std::max(edge, high[k] - low[k]);
  return edge;
}

double Extent::rim_of(double wall) const {
  if (cell_dimension == 2) return 2;
  const double edge = longest(), slimness = edge * edge * edge / measure;
  return 4 * std::min(edge, std::sqrt(wall * slimness));
}

Extent extent_of(const Domain& domain) {
  return {domain.cell_dimension(), domain.low(), domain.high(), domain.measure()};
}

Rounding::Rounding(const Extent& extent, const SeedsView& seeds, Precision precision)
    : extent_(extent), seeds_(seeds), unit_(precision == Precision::float32 ? 0x1p-24 : 0x1p-53) {
  for (std::size_t k = 0; k < 3; ++k) {
    diagonal_ = std::hypot(diagonal_, extent.high[k] - extent.low[k]);
    coordinate_ = std::max({coordinate_, std::abs(extent.low[k]), std::abs(extent.high[k])});
  }
  coordinate_ *= 4 * 0x1p-53;
}

Vector Rounding::position(std::size_t i) const {
  const double* p = &seeds_.positions[i * static_cast<std::size_t>(seeds_.dimension)];
  return {p[0], p[1], seeds_.dimension == 3 ? p[2] : 0.0};
}

double Rounding::least_measure(int cell_dimension) const {
  // 2^-100 in units of up to twice the domain's extent.
  return unit_ == 0x1p-24 ? 0x1p-97 * std::pow(diagonal_, cell_dimension) : 0;
}

double Rounding::reach(std::size_t i) const {
  const Vector p = position(i);
  double sum = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(seeds_.dimension); ++k)
    sum = std::hypot(sum, static_cast<double>(
                              std::max(std::fabs(p[k] - extent_.low[k]), std::fabs(p[k] - extent_.high[k]))));
  return sum;
}

double Rounding::shift(std::size_t i) const {
  return roundings * unit_ * reach(i) + coordinate_;
}

double Rounding::wall_shift(std::size_t i, std::size_t j) const {
  return wall_shift(i, j, position(j) - position(i));
}

double Rounding::wall_shift(std::size_t i, std::size_t j, const Vector& q) const {
  const long double length = std::sqrt(dot(q, q));
  return shift(i) +
         roundings * unit_ * static_cast<double>(length + std::fabs(weight(i) - weight(j)) / length);
}

double Rounding::shift(std::size_t i, const Border& border) const {
  return border.kind == Border::Kind::wall ? wall_shift(i, border.index) : shift(i);
}

long double Rounding::beyond(std::size_t i, std::size_t j, const Vector& x) const {
  return beyond(i, j, x - position(i), position(j) - position(i));
}

long double Rounding::beyond(std::size_t i, std::size_t j, const Vector& y, const Vector& q) const {
  return (2 * dot(q, y) - dot(q, q) - weight(i) + weight(j)) / (2 * std::sqrt(dot(q, q)));
}

}  // namespace powercell
