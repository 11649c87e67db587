/// \file
/// The regions that a cell can meet, found from its walls.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "lib/neighbors/cell_bounds.hpp"
#include "lib/pairs/pair_finder.hpp"
#include "lib/pairs/wall_loops.hpp"
#include "lib/regions/region_blocks.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell::pairs {

/// Coordinates are relative to the seed. The memory is reused from cell to cell.
struct CellHull {
  int dimension = 0;
  std::vector<double> vertex;       ///< all x, all y, all z; each padded to whole lanes with the last vertex
  std::array<double, 3> low, high;  ///< contains the true cell; the whole space if vertices are not known
  double error = 0;                 ///< bound for the distance of a vertex from the true one

  void set(const CellWalls& cells, std::uint32_t rank) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const std::span<const double> from = cells.vertices_of(rank);
    dimension = cells.dimension;
    const auto d = static_cast<std::size_t>(dimension);
    const std::size_t count = d == 0 ? 0 : from.size() / d;
    const std::size_t columns = (count + RegionGroups::fan - 1) / RegionGroups::fan * RegionGroups::fan;
    vertex.resize(columns * d);
    low.fill(-infinite);
    high.fill(infinite);
    error = 0;
    if (count == 0) return;
    for (std::size_t k = 0; k < d; ++k) {
      low[k] = infinite;
      high[k] = -infinite;
      for (std::size_t v = 0; v < columns; ++v) {
        const double x = from[std::min(v, count - 1) * d + k];
        vertex[k * columns + v] = x;
        low[k] = std::min(low[k], x);
        high[k] = std::max(high[k], x);
      }
      error += std::max(std::abs(low[k]), std::abs(high[k]));
    }
    error *= cells.vertex_error;
    for (std::size_t k = 0; k < d; ++k) {
      low[k] -= error;
      high[k] += error;
    }
  }

  bool empty() const { return vertex.empty(); }
  /// The least of direction . vertex.
  double least_along(const double* direction) const {
    return loops::least_along(direction, dimension, vertex.data(),
                              vertex.size() / static_cast<std::size_t>(dimension));
  }
};

/// The search of one thread, with its scratch memory. Descends the groups of regions with the bisectors that
/// meet their boxes; a group that no bisector meets lies inside the cell. A region is left out if it lies
/// beyond a bisector (11), or if one of its facets separates it from all vertices of the cell (12b).
class CellSearch {
 public:
  /// Keeps references.
  CellSearch(const RegionMesh& mesh, const RegionGroups& groups, const RegionBlocks& blocks,
             const SeedSet& seeds, const CellWalls& cells)
      : mesh_(mesh), groups_(groups), blocks_(blocks), seeds_(seeds), cells_(cells) {}

  /// Appends the regions that the cell of `rank` can meet, ascending.
  /// \param hull  of this cell
  void find(std::uint32_t rank, const CellHull& hull, std::vector<std::uint32_t>& regions);

 private:
  void set_bisectors(std::uint32_t rank);
  /// Appends the regions of a group that the bisectors [first, last) of bisectors_ do not exclude.
  void visit(std::size_t level, std::size_t group, std::size_t first, std::size_t last);
  void visit_regions(std::size_t group, std::size_t members, std::size_t first, std::size_t last);
  void add_all(std::size_t level, std::size_t group);
  bool beyond_a_facet(std::uint32_t region) const;
  /// Whether all vertices of the cell lie farther along the direction than the region.
  bool separated_along(const double* direction, std::uint32_t region) const;

  const RegionMesh& mesh_;
  const RegionGroups& groups_;
  const RegionBlocks& blocks_;
  const SeedSet& seeds_;
  const CellWalls& cells_;
  const double* seed_ = nullptr;
  std::vector<loops::Bisector> bisectors_;  // those of the cell, then those of each group on the way down
  const CellHull* hull_ = nullptr;
  std::vector<double> greatest_;
  std::vector<std::uint32_t>* found_ = nullptr;
};

/// Everything must outlive the search.
struct CellSearchInput {
  const RegionMesh& mesh;
  const RegionGroups& groups;
  const RegionBlocks& blocks;
  const SeedSet& seeds;
  std::span<const std::uint32_t> ranks;
  const CellWalls& walls;
  int threads;
  const std::function<bool(double)>& progress;
};

/// As PairFinder::by_cells.
Pairs search_cells(const CellSearchInput& search);

}  // namespace powercell::pairs
