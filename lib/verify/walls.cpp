#include <array>
#include <utility>

#include "lib/verify/asymmetry.hpp"
#include "lib/verify/laws.hpp"

namespace powercell {
namespace {

using Shift = std::array<std::int32_t, 3>;
using Image = std::pair<std::uint32_t, Shift>;

/// The neighbour of an entry, in a periodic domain with its image.
Image image_at(const Adjacency& adjacency, std::uint64_t k) {
  return {adjacency.neighbor[k], adjacency.shift.empty() ? Shift{} : adjacency.shift[k]};
}

/// The fault of row i; empty if it has none.
std::string fault_of(const Adjacency& adjacency, std::size_t i) {
  for (std::uint64_t at = adjacency.offset[i]; at < adjacency.offset[i + 1]; ++at) {
    const auto [j, shift] = image_at(adjacency, at);
    const std::string both = "seed " + std::to_string(i) + " and its neighbour " + std::to_string(j);
    if ((j == i && shift == Shift{}) || j + std::size_t{1} >= adjacency.offset.size())
      return both + ": not another seed";
    if (at > adjacency.offset[i] && image_at(adjacency, at - 1) >= Image(j, shift))
      return both + ": the row is not ascending";
    const Image back(static_cast<std::uint32_t>(i), {-shift[0], -shift[1], -shift[2]});
    std::uint64_t from = adjacency.offset[j];
    while (from < adjacency.offset[j + 1] && image_at(adjacency, from) < back) ++from;
    if (from == adjacency.offset[j + 1] || image_at(adjacency, from) != back)
      return both + ": the neighbour does not list the seed";
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
