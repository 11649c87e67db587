/// \file
/// One pass over all pairs of a plan, chunk by chunk: clip, integrate, collect. Internal.
#pragma once

#include <optional>
#include <powercell/results.hpp>
#include <vector>

#include "lib/collect/walls.hpp"
#include "lib/diagram/plan.hpp"

namespace powercell {

/// What to compute besides the measures.
struct Wanted {
  bool adjacency = false, cells = false;
};

/// What a pass came to. Where `flat` or `unclear` has ranks there are no results: it has to be repeated.
struct Clipped {
  std::optional<Measures> measures;
  std::optional<Adjacency> adjacency;
  std::optional<Cells> cells;
  std::vector<std::uint32_t> flat;     ///< cells that are exactly flat: to be excluded
  std::vector<std::uint32_t> unclear;  ///< unrestricted cells that have to be clipped by region
};

/// Buffers of little size that are kept from pass to pass.
struct Workspace {
  std::optional<ClipMemory> clip;
  WallRows::Memory walls;
};

/// \param timings  `clip`, `collect` and the counts are set
/// \throw Error interrupted, out_of_device_memory, opencl, build_failed, internal
Clipped clip(const Setup& setup, const Active& active, const Plan& plan, Wanted want, Workspace& workspace,
             Timings& timings);

}  // namespace powercell
