#include <algorithm>

#include "lib/verify/asymmetry.hpp"
#include "lib/verify/laws.hpp"

namespace powercell {
namespace {

/// The fault of row i; empty if it has none.
std::string fault_of(const Adjacency& adjacency, std::size_t i) {
  const auto row = row_of(adjacency, i);
  for (auto j = row.begin(); j != row.end(); ++j) {
    const std::string both = "seed " + std::to_string(i) + " and its neighbour " + std::to_string(*j);
    if (*j == i || *j + std::size_t{1} >= adjacency.offset.size()) return both + ": not another seed";
    if (j != row.begin() && j[-1] >= *j) return both + ": the row is not ascending";
    const auto other = row_of(adjacency, *j);
    const auto back = std::ranges::lower_bound(other, i);
    if (back == other.end() || *back != i) return both + ": the neighbour does not list the seed";
    const auto at = adjacency.offset[i] + static_cast<std::size_t>(j - row.begin());
    const auto from = adjacency.offset[*j] + static_cast<std::size_t>(back - other.begin());
    if (adjacency.wall[at] != adjacency.wall[from]) return both + ": the wall measures differ";
  }
  return {};
}

/// The fault of the first row that has one; empty if there is none.
std::string fault_of(const Adjacency& adjacency) {
  for (std::size_t i = 0; i + 1 < adjacency.offset.size(); ++i)
    if (std::string fault = fault_of(adjacency, i); !fault.empty()) return fault;
  return {};
}

}  // namespace

LawCheck check_walls(const Adjacency& adjacency, const RegionMesh* mesh, const Rounding& rounding) {
  LawCheck check{"symmetry: each wall is the same from both sides", false, adjacency.asymmetry, 0, {}};
  check.detail = fault_of(adjacency);
  if (!check.detail.empty()) return check;
  check.tolerance = allowed_asymmetry(adjacency, mesh, rounding);
  check.passed = adjacency.asymmetry <= check.tolerance;
  if (!check.passed) check.detail = text_of_asymmetry(adjacency);
  return check;
}

}  // namespace powercell
