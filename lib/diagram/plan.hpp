/// \file
/// How the cells of the active seeds are computed. Internal.
#pragma once

#include <memory>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/clip/clipper.hpp"
#include "lib/diagram/active.hpp"

namespace powercell {

/// What a plan serves. On surfaces and domains of one region both are the same.
enum class PlanKind {
  integrals,  ///< measures and adjacency: cells inside the domain in one piece, those at its boundary by
              ///< region
  geometry,   ///< every cell cut along the regions of the domain
};

/// Which pairs are clipped, and from which candidates. Refers to the setup and the active seeds that it was
/// made for.
struct Plan {
  Pairs pairs;
  std::unique_ptr<Candidates> candidates;
  bool unrestricted = false;  ///< pairs with the container are cells that may also lie outside the domain
  CellWalls walls;            ///< of cells that are cut by planes: their regions, for the host

  /// Those of the pairs that the host must clip region by region, as it has no planes of the boundary.
  /// \param pair_seed, pair_region  of a chunk of pairs   \param for_host  ascending, indices into these
  std::vector<SplitPair> split(const Setup& setup, const Active& active,
                               std::span<const std::uint32_t> pair_seed,
                               std::span<const std::uint32_t> pair_region,
                               std::span<const std::uint32_t> for_host) const;
};

/// Chooses the strategy, finds the pairs and makes the candidates. \param timings  `pairs`, `neighbors` and
/// `pair_count` are set \throw Error interrupted; opencl, out_of_device_memory, build_failed;
/// invalid_argument (options of lists)
Plan make_plan(const Setup& setup, const Active& active, PlanKind kind, Timings& timings);

}  // namespace powercell
