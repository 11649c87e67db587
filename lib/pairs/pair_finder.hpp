/// \file
/// Finds which seeds can meet which regions of the domain.
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
/// number after the last region stands for the container, a region around the whole domain (with_container):
/// a pair with it is the unrestricted cell.
struct Pairs {
  std::vector<std::uint64_t> offset;  ///< seeds + 1
  std::vector<std::uint32_t> region;
  /// Per region: all seeds that can meet it, ascending, if they are few, else no seeds. Empty if the domain
  /// has one region.
  std::vector<std::uint64_t> list_offset;  ///< regions + 1
  std::vector<std::uint32_t> list_seed;
  bool all_listed = false;  ///< every region with a pair has a list
};

/// Finds pairs for one domain. Structures that depend on the regions only are made when first needed, and
/// kept with the mesh for other finders. Thread-safe only where stated.
class PairFinder {
 public:
  /// Keeps a reference to the mesh.
  /// \param threads  0 for all
  PairFinder(const RegionMesh& mesh, int threads);
  ~PairFinder();

  /// A close superset of the pairs whose region and cell meet in more than a set of measure 0. Seed i is left
  /// out for a region only if for each part of the region some j has pow_j < pow_i at all corners (11), with
  /// a margin so that rounding never loses a pair. In a domain of one region every seed has a pair. Work and
  /// memory are near-linear for a million seeds in one region and for ten seeds on a million triangles. The
  /// result does not depend on `threads`.
  /// \param progress  as Options::progress
  /// \throw Error interrupted
  Pairs by_regions(const SeedSet& seeds, const PackedTree& tree,
                   const std::function<bool(double)>& progress = {}) const;

  /// The ranks whose cells can meet the boundary of the domain, and those of `by_region`, ascending.
  /// \param by_region  in any order
  /// \param progress   called with 0 only; the expensive stage comes later
  /// \throw Error interrupted
  std::vector<std::uint32_t> at_boundary(const SeedSet& seeds, const PackedTree& tree,
                                         std::span<const std::uint32_t> by_region,
                                         const std::function<bool(double)>& progress = {}) const;

  /// The pairs of cells whose unrestricted walls and vertices are known. A region is left out only if one of
  /// the walls or one of its facets separates it from the cell. There are no lists by region.
  /// \param ranks  ascending; all others have one pair, with the container
  /// \throw Error interrupted
  Pairs by_cells(const SeedSet& seeds, std::span<const std::uint32_t> ranks, const CellWalls& walls,
                 const std::function<bool(double)>& progress = {}) const;

  /// Point location in the regions; refers to the finder.
  RegionLocator locator() const;

 private:
  struct Boundary;
  const RegionGroups& groups() const;
  const RegionBlocks& blocks() const;
  const Boundary& boundary() const;

  const RegionMesh& mesh_;
  int threads_;
  // Of the mesh, from when they are needed.
  mutable std::shared_ptr<const RegionGroups> groups_;
  mutable std::shared_ptr<const RegionBlocks> blocks_;
  mutable std::shared_ptr<const Boundary> boundary_;
};

}  // namespace powercell
