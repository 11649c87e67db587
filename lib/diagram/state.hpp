/// \file
/// What a Diagram keeps between calls: a chain of values, each made from those before it. Internal.
#pragma once

#include <optional>
#include <powercell/diagram.hpp>
#include <vector>

#include "lib/diagram/clip.hpp"

namespace powercell {

struct Diagram::State {
  Setup setup;
  std::optional<Input> input;
  std::optional<Active> active;             // of the input
  std::optional<Plan> integrals, geometry;  // of the active seeds, by PlanKind

  struct Results {
    std::optional<Measures> measures;
    std::optional<Adjacency> adjacency;
    std::optional<Cells> cells;
    std::optional<Dual> dual;
  } results;
  Timings timings;

  // Memory that the next values are made in.
  SeedBuffers seed_buffers;
  std::optional<PackedTree> tree;  // of the last active seeds, while the positions are the same
  Workspace workspace;

  State(Device device, Domain domain, Options options)
      : setup(std::move(device), std::move(domain), std::move(options)),
        seed_buffers(setup.device.context()) {}

  void set_seeds(const SeedsView& seeds);
  void set_weights(std::span<const double> weights);
  /// Computes the measures, and what else is wanted and missing. \throw as Diagram::compute
  void compute(Wanted want);
  const Dual& dual();

 private:
  /// Forgets all that depends on the seeds.
  void retire_active();
  Plan& plan(PlanKind kind);
  /// Clips until no cell is left to be excluded or restricted, and takes the results over.
  void pass(PlanKind kind, Wanted want);
  Clipped clip_once(PlanKind kind, Wanted want);
  void compute_missing(Wanted want);
  /// \throw Error internal unless the results keep their laws; forgets them then
  void certify();
};

}  // namespace powercell
