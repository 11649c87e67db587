#include "tests/pairs/true_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/support/brute_force.hpp"
#include "tests/support/polytope.hpp"

namespace powercell::test {
namespace {

Vec corner(const RegionMesh& mesh, std::uint32_t slot, const SeedSet& seeds, std::uint32_t origin) {
  Real x[3] = {0, 0, 0};
  const std::size_t d = static_cast<std::size_t>(mesh.dimension);
  for (std::size_t k = 0; k < d; ++k)
    x[k] = Real{mesh.vertices[mesh.region_vertex[slot] * d + k]} - Real{seeds.positions[origin * d + k]};
  return {x[0], x[1], x[2]};
}

constexpr Border outside{Border::Kind::boundary, 0};

Polygon polygon_of(const std::vector<Vec>& corners) {
  return {corners, std::vector<Border>(corners.size(), outside)};
}

Polyhedron polyhedron_of(const std::vector<Vec>& corners) {
  Polyhedron p;
  p.vertices = corners;
  if (corners.size() == 4)
    for (const std::vector<std::uint32_t>& ring :
         std::vector<std::vector<std::uint32_t>>{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}})
      p.faces.push_back({ring, outside});
  else
    for (const std::vector<std::uint32_t>& ring : std::vector<std::vector<std::uint32_t>>{
             {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
      p.faces.push_back({ring, outside});
  return p;
}

/// Cuts `piece` by all others, those of least power first, since they empty it soonest. Returns whether a
/// part is left.
template <class Polytope>
bool meets(Polytope piece, const SeedsView& view, std::uint32_t i, const std::vector<std::uint32_t>& others) {
  // Cuts through a corner leave slivers as thin as the rounding of long double, about 1e-19 of the length.
  const Real nothing = 1e-16L * moments(piece).measure;
  for (const std::uint32_t j : others) {
    if (j == i) continue;
    piece = clip(piece, bisector(view, i, j), outside);
    if (piece.empty() || !(moments(piece).measure > nothing)) return false;
  }
  return true;
}

}  // namespace

PairSet true_pairs(const RegionMesh& mesh, const SeedSet& seeds) {
  const SeedsView view{seeds.dimension, seeds.positions, seeds.weights};
  const std::size_t d = static_cast<std::size_t>(mesh.dimension);
  PairSet found;
  std::vector<std::uint32_t> others(seeds.size());
  std::vector<Real> key(seeds.size());
  for (std::uint32_t r = 0; r < mesh.region_count(); ++r) {
    const std::uint32_t first = mesh.region_offset[r], last = mesh.region_offset[r + 1];
    std::vector<double> centroid(d, 0.0);
    for (std::uint32_t slot = first; slot < last; ++slot)
      for (std::size_t k = 0; k < d; ++k)
        centroid[k] += mesh.vertices[mesh.region_vertex[slot] * d + k] / (last - first);
    for (std::uint32_t i = 0; i < seeds.size(); ++i) key[i] = power(view, i, centroid);
    std::iota(others.begin(), others.end(), 0u);
    std::sort(others.begin(), others.end(), [&](auto a, auto b) { return key[a] < key[b]; });
    for (std::uint32_t i = 0; i < seeds.size(); ++i) {
      std::vector<Vec> corners;
      for (std::uint32_t slot = first; slot < last; ++slot) corners.push_back(corner(mesh, slot, seeds, i));
      const bool met = mesh.cell_dimension == 2 ? meets(polygon_of(corners), view, i, others)
                                                : meets(polyhedron_of(corners), view, i, others);
      if (met) found.emplace(r, i);
    }
  }
  return found;
}

PairSet as_set(const Pairs& pairs) {
  PairSet all;
  for (std::uint32_t i = 0; i + 1 < pairs.offset.size(); ++i)
    for (std::uint64_t k = pairs.offset[i]; k < pairs.offset[i + 1]; ++k) all.emplace(pairs.region[k], i);
  return all;
}

}  // namespace powercell::test
