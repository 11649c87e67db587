/// \file
/// The strategy by which the cells of the active seeds are computed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/clip/clipper.hpp"
#include "lib/collect/walls.hpp"
#include "lib/diagram/active_seeds.hpp"
#include "lib/diagram/selection.hpp"

namespace powercell {

/// The results that a plan computes. On surfaces, in domains of one region and for a selection both kinds are
/// the same.
enum class PlanKind {
  integrals,  ///< measures and adjacency: only cells at the boundary are cut by region
  geometry,   ///< every cell is cut along the regions of the domain; in a solid all results
};

/// The pairs to clip, and their candidates. Refers to the setup and the active seeds it was made for.
struct ClipPlan {
  std::size_t seeds = 0;  ///< with images: the candidates are for these
  /// The cells to compute if they are not all; the rows of `pairs` are then these instead of ranks.
  std::optional<SelectedRows> selected;
  Pairs pairs;
  std::unique_ptr<Candidates> candidates;
  /// Of a group of devices: those of its further members, made on first use.
  std::vector<std::unique_ptr<Candidates>> copies;
  bool unrestricted = false;  ///< pairs with the container are cells inside or outside the domain
  /// Cells without pairs, computed from the boundary.
  std::optional<SolidCells> solid;
  ClipStatistics solid_statistics;
};

/// Larger buffers are freed after a pass, because other work needs the memory.
inline constexpr std::size_t kept_bytes = std::size_t{16} << 20;

/// Domain and seeds on a further device of a group.
struct DeviceScene {
  DeviceScene(const std::shared_ptr<cl::Context>& context, const RegionMesh& mesh, bool float32)
      : domain(context, mesh, float32), seeds(context) {}

  DomainBuffers domain;
  SeedBuffers seeds;
  std::uint64_t uploads = 0;  ///< ActiveSeeds::uploads() of these seeds
};

/// What a device keeps from pass to pass.
struct DeviceWorkspace {
  std::array<std::optional<ClipMemory>, 2> clip;  ///< small, by chunk of the device
  std::unique_ptr<DeviceScene> scene;             ///< null on the first device, and before it is used
  double speed = 0;         ///< pairs a second in the last pass that the device had a part in
  std::uint64_t pairs = 0;  ///< that it clipped in the last pass that was shared
};

/// What is reused by the next pass.
struct Workspace {
  explicit Workspace(std::size_t device_count) : devices(device_count) {}

  std::vector<DeviceWorkspace> devices;  ///< DiagramSetup::members

  /// The search of all active seeds, of a plan that another selection replaces; null where there is none.
  std::unique_ptr<Candidates> search;
  std::optional<ClipMemory> facets;  ///< of clipping the boundary of a solid
  WallRows::Memory walls;
  bool keeps_walls = false;  ///< `walls` however large, because the next pass follows at once
};

/// Candidates for any pairs in a domain of one region.
/// \throw Error as make_plan
std::unique_ptr<Candidates> search_all(const DiagramSetup& setup, const Scene& scene);

/// Chooses the strategy, finds the pairs and makes the candidates.
/// \param selection  null for all cells; else those to compute, in a domain that is not a solid
/// \param timings  sets `pairs`, `neighbors` and `pair_count`
/// \throw Error interrupted; opencl, out_of_device_memory, build_failed; invalid_argument (options of lists)
ClipPlan make_plan(const DiagramSetup& setup, const ActiveSeeds& active, PlanKind kind,
                   const Selection* selection, Workspace& workspace, Timings& timings);

}  // namespace powercell
