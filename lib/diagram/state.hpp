/// \file
/// The state of a Diagram: a chain of values, each made from those before it.
#pragma once

#include <memory>
#include <optional>
#include <powercell/diagram.hpp>
#include <vector>

#include "lib/diagram/clip.hpp"

namespace powercell {

struct Diagram::State {
  DiagramSetup setup;
  std::optional<GivenSeeds> input;
  std::optional<Selection> selection;           // of the input; without one all cells are computed
  std::optional<ActiveSeeds> active;            // of the input
  std::optional<ClipPlan> integrals, geometry;  // of the active seeds, by PlanKind

  struct Results {
    std::optional<Measures> measures;
    std::optional<Adjacency> adjacency;
    std::optional<Cells> cells;
    std::optional<JoinedCells> joined;
    std::optional<std::vector<std::uint32_t>> simplices;  ///< of a solid (SolidGeometry)
    std::optional<Dual> dual;
    std::optional<BoundaryWalls> boundary_walls;
    std::optional<std::vector<double>> reach;  ///< Clipped::reach
    std::vector<std::uint32_t> unproved;       ///< Clipped::unproved
  };
  /// Shared with callers who hold the results while the seeds change: replaced then, not cleared.
  std::shared_ptr<Results> results = std::make_shared<Results>();
  Timings timings;

  // Memory reused by the next values.
  SeedBuffers seed_buffers;
  std::optional<KeptTree> tree;  // of the last active seeds, while the positions are the same
  Workspace workspace;

  State(Device device, Domain domain, Options options)
      : setup(std::move(device), std::move(domain), std::move(options)),
        seed_buffers(setup.device.context()),
        workspace(setup.members.size()) {}

  void set_seeds(const SeedsView& seeds);
  void set_weights(std::span<const double> weights);
  void select(std::span<const std::uint32_t> seeds);
  void select_all();
  /// Computes the measures and the wanted results, as far as they are missing.
  /// \throw as Diagram::compute
  void compute(Wanted want);
  /// \throw Error unsupported for a solid
  const Cells& cells();
  const JoinedCells& joined();
  const Dual& dual();
  const BoundaryWalls& boundary_walls();

 private:
  /// Discards everything that depends on the seeds, except their tree.
  void retire_active();
  void make_active();
  ClipPlan& plan(PlanKind kind);
  /// The computation: active seeds, plan, clip, results; repeatedly if cells must be excluded or restricted.
  void pass(PlanKind kind, Wanted want);
  void store(Clipped&& clipped);
  /// Calls `body` again without the kept buffers where it runs out of device memory.
  template <class Body>
  auto within_memory(const Body& body);
  /// Frees the kept buffers of the devices; false if there are none.
  bool release_memory();
  void compute_missing(Wanted want);
  /// Computes the selected cells of a solid: all cells, of which the others are dropped.
  void compute_in_solid(Wanted want);
  /// Checks the laws of the results; discards the results if one fails.
  /// \throw Error internal
  void certify();
};

}  // namespace powercell
