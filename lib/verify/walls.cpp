#include <algorithm>
#include <cmath>

#include "lib/digits.hpp"
#include "lib/verify/laws.hpp"

namespace powercell {
namespace {

/// What is wrong with row i, or nothing.
std::string fault_of(const Adjacency& adjacency, std::size_t i) {
  const auto row = [&](std::size_t r) {
    const auto* begin = adjacency.neighbor.data();
    return std::pair{begin + adjacency.offset[r], begin + adjacency.offset[r + 1]};
  };
  const auto [begin, end] = row(i);
  for (const std::uint32_t* j = begin; j != end; ++j) {
    const std::string both = "seed " + std::to_string(i) + " and its neighbour " + std::to_string(*j);
    if (*j == i || *j + std::size_t{1} >= adjacency.offset.size()) return both + ": not another seed";
    if (j != begin && j[-1] >= *j) return both + ": the row is not ascending";
    const auto [other, other_end] = row(*j);
    const auto* back = std::lower_bound(other, other_end, i);
    if (back == other_end || *back != i) return both + ": the neighbour does not list the seed";
    if (adjacency.wall[static_cast<std::size_t>(j - adjacency.neighbor.data())] !=
        adjacency.wall[static_cast<std::size_t>(back - adjacency.neighbor.data())])
      return both + ": the wall measures differ";
  }
  return {};
}

}  // namespace

LawCheck check_walls(const Adjacency& adjacency, const Domain& domain, const Rounding& rounding) {
  const std::size_t n = adjacency.offset.size() - 1;
  // The ends of a wall are where planes meet, and move by the planes' rounding over the sine of the angle
  // between them. Of many random angles the least is about one over their number. However many there are,
  // no large wall may lack a side; where planes meet at right angles, one of a few tens of roundings may.
  constexpr double right_angles = 128;
  const double largest =
      adjacency.wall.empty() ? 0 : *std::max_element(adjacency.wall.begin(), adjacency.wall.end());
  const double rounded = rounding.unit() * rounding.diagonal() * rim_of(largest, domain);
  const double tolerance = std::max(right_angles * rounded,
                                    std::min(largest / 2, rounded * (1000 + static_cast<double>(n))));
  LawCheck check{"symmetry: each wall is the same from both sides",
                 adjacency.asymmetry <= tolerance,
                 adjacency.asymmetry,
                 tolerance,
                 {}};
  if (!check.passed) check.detail = "the two sides of a wall differ by " + digits(adjacency.asymmetry, 3);
  for (std::size_t i = 0; i < n; ++i) {
    std::string fault = fault_of(adjacency, i);
    if (fault.empty()) continue;
    check.passed = false;
    check.detail = std::move(fault);
    break;
  }
  return check;
}

}  // namespace powercell
