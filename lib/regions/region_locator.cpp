#include "lib/regions/region_locator.hpp"

#include <algorithm>
#include <cmath>

#include "lib/base/vectors.hpp"

namespace powercell {
namespace {

using Vector = Vector3<double>;

/// Relative to the terms of a determinant. Bounds their rounding, and that of coordinates relative to a
/// corner.
constexpr double rounding = 1e-14;

Vector difference(const double* a, const double* b, std::size_t d) {
  Vector v{};
  for (std::size_t k = 0; k < d; ++k) v[k] = a[k] - b[k];
  return v;
}

double size(const Vector& v) {
  return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
}

/// Positive if x is on the inner side of the edge a b of a polygon, or of the facet a b c of a tetrahedron,
/// counter-clockwise from outside; 0 within rounding.
double height(const Vector& ab, const Vector& ax) {
  const double value = ab[0] * ax[1] - ab[1] * ax[0];
  return std::abs(value) > rounding * size(ab) * size(ax) ? value : 0;
}
double height(const Vector& ab, const Vector& ac, const Vector& ax) {
  const double value = -dot(ax, cross(ab, ac));
  return std::abs(value) > rounding * size(ab) * size(ac) * size(ax) ? value : 0;
}

}  // namespace

RegionLocator::Side RegionLocator::side_of(std::uint32_t region, const Vector& x) const {
  const std::uint32_t first = mesh_.region_offset[region], count = mesh_.region_offset[region + 1] - first;
  const auto d = static_cast<std::size_t>(mesh_.dimension);
  const auto corner = [&](std::uint32_t k) {
    return &mesh_.vertices[std::size_t{mesh_.region_vertex[first + k]} * d];
  };
  Side side = Side::inside;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double* a = d == 2 ? corner(k) : corner(tetrahedron_facet[k][0]);
    const double* b = d == 2 ? corner(k + 1 == count ? 0 : k + 1) : corner(tetrahedron_facet[k][1]);
    const Vector ab = difference(b, a, d), ax = difference(x.data(), a, d);
    const double h =
        d == 2 ? height(ab, ax) : height(ab, difference(corner(tetrahedron_facet[k][2]), a, d), ax);
    if (h < 0) return Side::outside;
    if (!(h > 0)) side = Side::unclear;
  }
  return side;
}

bool RegionLocator::count_below(std::size_t level, std::size_t group, const Vector& x, int& found) const {
  if (level == 0) {
    const Side side = side_of(groups_.order[group], x);
    found += side == Side::inside;
    return side == Side::unclear;
  }
  const std::size_t below = groups_.level[level - 1].low.size() / static_cast<std::size_t>(mesh_.dimension);
  const std::size_t first = group * RegionGroups::fan, members = std::min(RegionGroups::fan, below - first);
  constexpr Vector here{};
  Lanes gap;
  blocks_.find_gaps(level - 1, group, x.data(), here.data(), here.data(), gap);
  bool unclear_inside = false;
  for (std::size_t lane = 0; lane < members; ++lane)
    if (!(gap[lane] > 0)) unclear_inside |= count_below(level - 1, first + lane, x, found);
  return unclear_inside;
}

int RegionLocator::regions_at(const Vector& x) const {
  int found = 0;
  return count_below(groups_.level.size() - 1, 0, x, found) ? unclear : found;
}

}  // namespace powercell
