#include <algorithm>
#include <array>
#include <span>

#include "lib/digits.hpp"
#include "lib/verify/laws.hpp"

namespace powercell {
namespace {

using Row = std::span<const std::uint32_t>;

Row row_of(const Adjacency& adjacency, std::size_t i) {
  return Row(adjacency.neighbor).subspan(adjacency.offset[i], adjacency.offset[i + 1] - adjacency.offset[i]);
}

/// The least sine of an angle of a triangle of seeds: that between the two longer sides.
long double least_sine(const Vector& a, const Vector& b, const Vector& c) {
  std::array<long double, 3> side{length(b - a), length(c - b), length(a - c)};
  std::ranges::sort(side);
  return length(cross(b - a, c - a)) / (side[1] * side[2]);
}

/// The least over all seeds that are neighbours of each other. Their bisectors meet in a line, and each of
/// their cells ends one of its walls there at another of them, at an angle of the triangle.
long double least_sine(const Adjacency& adjacency, const Rounding& rounding) {
  long double least = 1;
  for (std::uint32_t i = 0; i + std::size_t{1} < adjacency.offset.size(); ++i)
    for (const std::uint32_t j : row_of(adjacency, i)) {
      if (j < i) continue;
      Row few = row_of(adjacency, i), many = row_of(adjacency, j);
      if (few.size() > many.size()) std::swap(few, many);
      for (auto k = std::ranges::upper_bound(few, j); k != few.end(); ++k)
        if (std::ranges::binary_search(many, *k))
          least =
              std::min(least, least_sine(rounding.position(i), rounding.position(j), rounding.position(*k)));
    }
  return least;
}

/// What is wrong with row i, or nothing.
std::string fault_of(const Adjacency& adjacency, std::size_t i) {
  const Row row = row_of(adjacency, i);
  for (auto j = row.begin(); j != row.end(); ++j) {
    const std::string both = "seed " + std::to_string(i) + " and its neighbour " + std::to_string(*j);
    if (*j == i || *j + std::size_t{1} >= adjacency.offset.size()) return both + ": not another seed";
    if (j != row.begin() && j[-1] >= *j) return both + ": the row is not ascending";
    const Row other = row_of(adjacency, *j);
    const auto back = std::ranges::lower_bound(other, i);
    if (back == other.end() || *back != i) return both + ": the neighbour does not list the seed";
    const auto at = adjacency.offset[i] + static_cast<std::size_t>(j - row.begin());
    const auto from = adjacency.offset[*j] + static_cast<std::size_t>(back - other.begin());
    if (adjacency.wall[at] != adjacency.wall[from]) return both + ": the wall measures differ";
  }
  return {};
}

/// What is wrong with the rows, or nothing.
std::string fault_of(const Adjacency& adjacency) {
  for (std::size_t i = 0; i + 1 < adjacency.offset.size(); ++i)
    if (std::string fault = fault_of(adjacency, i); !fault.empty()) return fault;
  return {};
}

/// What the sides of a wall may differ by. The ends of a wall are where planes meet, and move by the planes'
/// rounding over the sine of the angle between them. Of many random angles the least is about one over their
/// number; it is looked for where more is wanted. However small it is, no large wall may lack a side; where
/// planes meet at right angles, one of a few tens of roundings may.
/// \param adjacency  whose rows have no fault
double allowed_asymmetry(const Adjacency& adjacency, const Domain& domain, const Rounding& rounding) {
  constexpr double right_angles = 128, slanted = 8;
  const double largest =
      adjacency.wall.empty() ? 0 : *std::max_element(adjacency.wall.begin(), adjacency.wall.end());
  const double rounded = rounding.unit() * rounding.diagonal() * rim_of(largest, domain);
  const auto within = [&](double allowed) {
    return std::max(right_angles * rounded, std::min(largest / 2, allowed));
  };
  const auto n = static_cast<double>(adjacency.offset.size() - 1);
  const double usual = within(rounded * (1000 + n));
  if (adjacency.asymmetry <= usual) return usual;
  const auto sine = static_cast<double>(least_sine(adjacency, rounding));
  return std::max(usual, within(slanted * rounded / sine));
}

}  // namespace

LawCheck check_walls(const Adjacency& adjacency, const Domain& domain, const Rounding& rounding) {
  LawCheck check{"symmetry: each wall is the same from both sides", false, adjacency.asymmetry, 0, {}};
  check.detail = fault_of(adjacency);
  if (!check.detail.empty()) return check;
  check.tolerance = allowed_asymmetry(adjacency, domain, rounding);
  check.passed = adjacency.asymmetry <= check.tolerance;
  if (!check.passed) check.detail = "the two sides of a wall differ by " + digits(adjacency.asymmetry, 3);
  return check;
}

}  // namespace powercell
