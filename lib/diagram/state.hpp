/// \file
/// What a Diagram keeps between calls.
#pragma once

#include <memory>
#include <optional>
#include <powercell/diagram.hpp>
#include <vector>

#include "lib/clip/candidates.hpp"
#include "lib/clip/scene.hpp"
#include "lib/pairs/enumerate.hpp"

namespace powercell {

/// The precision that the option means on this device. \throw Error no_fp64
Precision choose_precision(const Device& device, Precision asked);

struct Diagram::State {
  Device device;
  Domain domain;
  Options options;
  Precision precision;
  Neighbors neighbors;
  Scene scene;

  SeedSet seeds;
  // Of the duplicates, which `seeds` has not, in their order.
  std::vector<double> duplicate_positions, duplicate_weights;
  bool given = false;    // set_seeds has been called
  bool ordered = false;  // the tree and its boxes on the device belong to the positions
  bool paired = false;   // the pairs belong to the positions, and to some weights
  bool ready = false;    // tree, pairs and device buffers belong to the positions and weights
  PackedTree tree;
  Pairs pairs;
  std::unique_ptr<Candidates> candidates;
  Timings timings;

  std::optional<Measures> measures;
  std::optional<Adjacency> adjacency;
  std::optional<Cells> cells;
  std::optional<Dual> dual;

  State(Device device, Domain domain, Options options);
  void forget_results();
  /// Tree, pairs, device buffers and candidate source for the present seeds and weights.
  void prepare();
  std::unique_ptr<Candidates> make_candidates() const;
  /// Clips all pairs and fills measures, and adjacency and cells where asked.
  void run(bool want_adjacency, bool want_cells);
};

}  // namespace powercell
