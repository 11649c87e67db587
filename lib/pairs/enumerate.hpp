/// \file
/// Which seeds can meet which regions of the domain.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "lib/domain/region_mesh.hpp"
#include "lib/neighbors/cell_planes.hpp"
#include "lib/neighbors/cell_walls.hpp"
#include "lib/seeds/packed_tree.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// Candidate pairs by seed: rank i may meet the regions region[offset[i] .. offset[i+1]), ascending.
struct Pairs {
  std::vector<std::uint64_t> offset;  ///< seeds + 1
  std::vector<std::uint32_t> region;
  /// By region: all seeds that can meet it, ascending, where they are few and some pair has the region; else
  /// none. Empty if the domain has one region.
  std::vector<std::uint64_t> list_offset;  ///< regions + 1
  std::vector<std::uint32_t> list_seed;
  bool all_listed = false;  ///< every pair has a region with a list
  /// Of the cells with a pair with the region around the domain, those that are to be cut by planes as well.
  CellPlanes planes;
};

/// Cells that may meet the boundary of the domain.
struct BoundaryRanks {
  std::vector<std::uint32_t> ranks;      ///< ascending
  std::vector<std::uint32_t> by_region;  ///< of those, ascending: pairs with regions only
};

class RegionLocator;
struct RegionBlocks;
struct RegionGroups;
namespace pairs {
class BoundaryPlanes;
}

/// Finds pairs for one domain. What depends on the regions alone is kept.
class PairFinder {
 public:
  /// Keeps a reference to the mesh. \param threads 0 for all
  PairFinder(const RegionMesh& mesh, int threads);
  ~PairFinder();
  PairFinder(PairFinder&&) noexcept;

  /// A superset of the pairs with region and cell meeting in more than nothing, close to the true set:
  /// seed i is left out for a region only if some j has pow_j < pow_i at all corners of each part of the
  /// region (exact exclusion with a safe margin, so that rounding never loses a pair). A domain of one
  /// region gives every seed. No quadratic work or memory: a million seeds in one region and ten seeds
  /// on a million triangles are both near-linear. The result does not depend on `threads`.
  /// \param progress as Options::progress
  Pairs all(const SeedSet& seeds, const PackedTree& tree,
            const std::function<bool(double)>& progress = {}) const;

  /// The same, but a seed whose cell cannot meet the boundary of the domain has one pair, with the region
  /// behind the last, which stands for a region around the whole domain (with_container). Such a cell may
  /// also be wholly outside. \param not_whole ranks that get their pairs with regions all the same
  Pairs with_whole_cells(const SeedSet& seeds, const PackedTree& tree,
                         std::span<const std::uint32_t> not_whole,
                         const std::function<bool(double)>& progress = {});

  /// The ranks whose cells can meet the boundary of the domain, and those in `by_region`, in any order.
  /// \param progress  is told 0: what takes longer follows
  BoundaryRanks at_boundary(const SeedSet& seeds, const PackedTree& tree,
                            std::span<const std::uint32_t> by_region,
                            const std::function<bool(double)>& progress = {});

  /// As with_whole_cells, where the cells of at_boundary() are known by their walls and vertices: a region is
  /// left out only if one of these walls or one of its own facets parts it from the cell. Pairs have no lists
  /// by region. A cell that the domain is convex around has one pair, with the region behind the last, and
  /// planes. \param ranks  of at_boundary(); others have one pair, with the region behind the last \param
  /// planes whether cells may be cut by planes
  Pairs of_cells(const SeedSet& seeds, const BoundaryRanks& ranks, const CellWalls& walls, bool planes,
                 const std::function<bool(double)>& progress = {});

  /// The regions that of_cells() finds for one cell without planes. Thread-safe. \pre of_cells() has been
  /// called
  std::vector<std::uint32_t> regions_of(const SeedSet& seeds, std::uint32_t rank,
                                        const CellWalls& walls) const;

  /// For what looks points up in the regions. \pre the finder stays where it is
  RegionLocator locator();

 private:
  const RegionBlocks& blocks();

  const RegionMesh& mesh_;
  int threads_;
  std::unique_ptr<RegionGroups> groups_, boundary_groups_;
  std::unique_ptr<RegionBlocks> blocks_;
  std::unique_ptr<pairs::BoundaryPlanes> planes_;
  std::unique_ptr<RegionMesh> boundary_;
};

/// PairFinder::all once.
Pairs enumerate_pairs(const RegionMesh& mesh, const SeedSet& seeds, const PackedTree& tree, int threads,
                      const std::function<bool(double)>& progress = {});

}  // namespace powercell
