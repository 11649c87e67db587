/// \file
/// One pass over all pairs of a plan, chunk by chunk: clip, integrate, collect.
#pragma once

#include <optional>
#include <powercell/results.hpp>
#include <vector>

#include "lib/collect/join_solid.hpp"
#include "lib/collect/walls.hpp"
#include "lib/diagram/clip_plan.hpp"

namespace powercell {

/// The results to compute besides the measures.
struct Wanted {
  bool adjacency = false;
  bool cells = false;  ///< the geometry: of a solid the joined cells
  bool reach = false;  ///< how far each cell reaches, of a selection
  /// Of a selection in a periodic domain: name the cells that reach too far for the images at hand, which may
  /// be too large, and make no more images.
  bool unproved = false;
  /// Of a selection whose domain is not periodic: whether the adjacency has walls, and ascending rows.
  bool walls = true;
};

/// The outcome of a pass: results, or ranks because of which it must be repeated.
struct Clipped {
  std::optional<Measures> measures;
  std::optional<Adjacency> adjacency;
  std::optional<Cells> cells;
  std::optional<SolidGeometry> solid;  ///< in place of cells
  /// By row of the results: the distance of the farthest vertex from the seed, as accurate as vertices are; 0
  /// where the cell is empty.
  std::optional<std::vector<double>> reach;
  std::vector<std::uint32_t> unproved;  ///< ascending: rows of the results
  std::vector<std::uint32_t> flat;      ///< seeds with exactly flat cells, to be excluded
  std::vector<std::uint32_t> unclear;   ///< unrestricted cells that must be clipped by region
};

/// Of a periodic domain `active` gets more images if cells reach too far for those that it has, and only
/// these cells are clipped again.
///
/// \param plan  gets its candidates copied to the further devices of a group
/// \param timings  sets `clip`, `collect` and the counts; adds the time of lists to `neighbors`
/// \throw Error interrupted, out_of_device_memory, opencl, build_failed, self_test_failed, internal
Clipped clip(const DiagramSetup& setup, ActiveSeeds& active, ClipPlan& plan, Wanted want,
             Workspace& workspace, Timings& timings);

}  // namespace powercell
