/// \file
/// Which seeds can meet which regions of the domain.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "lib/domain/region_mesh.hpp"
#include "lib/neighbors/cell_bounds.hpp"
#include "lib/regions/region_locator.hpp"
#include "lib/seeds/packed_tree.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// Candidate pairs by seed: rank i may meet the regions region[offset[i] .. offset[i+1]), ascending. The
/// number behind the last region stands for the container, a region around the whole domain (with_container):
/// a pair with it takes the cell unrestricted.
struct Pairs {
  std::vector<std::uint64_t> offset;  ///< seeds + 1
  std::vector<std::uint32_t> region;
  /// By region: all seeds that can meet it, ascending, where they are few and the region has a pair; else
  /// none. Empty if the domain has one region.
  std::vector<std::uint64_t> list_offset;  ///< regions + 1
  std::vector<std::uint32_t> list_seed;
  bool all_listed = false;  ///< every region with a pair has a list
  /// The unrestricted cells that have to be cut by planes of the boundary as well.
  CellPlanes planes;
};

/// Cells that may meet the boundary of the domain.
struct BoundaryRanks {
  std::vector<std::uint32_t> ranks;      ///< ascending
  std::vector<std::uint32_t> by_region;  ///< those of them, ascending, that have pairs with regions only
};

namespace pairs {
class BoundaryPlanes;
}

/// Finds pairs for one domain; keeps what depends on the regions alone from call to call. Not thread-safe
/// except where said.
class PairFinder {
 public:
  /// Keeps a reference to the mesh. \param threads 0 for all
  PairFinder(const RegionMesh& mesh, int threads);
  ~PairFinder();

  /// A superset of the pairs whose region and cell meet in more than a set of measure 0, close to the true
  /// set: seed i is left out for a region only if some j has pow_j < pow_i at all corners of each part of the
  /// region (exact exclusion with a safe margin, so that rounding never loses a pair). A domain of one
  /// region gives every seed. No quadratic work or memory: a million seeds in one region and ten seeds
  /// on a million triangles are both near-linear. The result does not depend on `threads`.
  /// \param progress as Options::progress
  Pairs by_regions(const SeedSet& seeds, const PackedTree& tree,
                   const std::function<bool(double)>& progress = {}) const;

  /// The ranks whose cells can meet the boundary of the domain, and those in `by_region`, in any order.
  /// \param progress  called with 0 only; the expensive stage comes later
  BoundaryRanks at_boundary(const SeedSet& seeds, const PackedTree& tree,
                            std::span<const std::uint32_t> by_region,
                            const std::function<bool(double)>& progress = {}) const;

  /// The pairs of cells whose unrestricted walls and vertices are known: a region is left out only if one of
  /// the walls or one of its own facets separates it from the cell. Pairs have no lists by region. A cell
  /// that the domain is convex around has one pair, with the container, and planes. \param ranks  of
  /// at_boundary(); others have one pair, with the container \param planes whether cells may be cut by planes
  Pairs by_cells(const SeedSet& seeds, const BoundaryRanks& ranks, const CellWalls& walls, bool planes,
                 const std::function<bool(double)>& progress = {}) const;

  /// The regions that by_cells() finds for one cell without planes. Thread-safe after by_cells().
  std::vector<std::uint32_t> regions_of(const SeedSet& seeds, std::uint32_t rank,
                                        const CellWalls& walls) const;

  /// Finds the regions at points. Keeps references to the finder; thread-safe.
  RegionLocator locator() const;

 private:
  struct Boundary;
  const RegionGroups& groups() const;
  const RegionBlocks& blocks() const;
  const Boundary& boundary() const;

  const RegionMesh& mesh_;
  int threads_;
  // Made when first needed.
  mutable std::unique_ptr<RegionGroups> groups_;
  mutable std::unique_ptr<RegionBlocks> blocks_;
  mutable std::unique_ptr<Boundary> boundary_;
};

}  // namespace powercell
