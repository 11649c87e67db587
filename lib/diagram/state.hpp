/// \file
/// What a Diagram keeps between calls.
#pragma once

#include <memory>
#include <optional>
#include <powercell/diagram.hpp>
#include <span>
#include <vector>

#include "lib/clip/clipper.hpp"
#include "lib/collect/walls.hpp"
#include "lib/neighbors/candidates.hpp"
#include "lib/pairs/enumerate.hpp"
#include "lib/scene/scene.hpp"

namespace powercell {

/// The precision that the option means on this device. \throw Error no_fp64
Precision choose_precision(const Device& device, Precision asked);

struct Diagram::State {
  Device device;
  Domain domain;
  Options options;
  Precision precision;
  Neighbors neighbors;
  RegionMesh clip_mesh;  // where cells can be wholly inside: the regions and a container behind them
  Scene scene;

  SeedSet seeds;
  std::optional<SeedSet> rest;  // `seeds` without those known to be hidden, if these are many
  // Of the duplicates, which `seeds` has not, in their order.
  std::vector<double> duplicate_positions, duplicate_weights;
  bool given = false;    // set_seeds has been called
  bool sifted = false;   // `rest` belongs to the weights
  bool ordered = false;  // the tree and its boxes on the device belong to the positions
  bool paired = false;   // the pairs belong to the positions, and to some weights
  bool ready = false;    // tree, pairs, candidates and device buffers belong to the positions and weights
  PackedTree tree;
  std::optional<PairFinder> finder;
  Pairs pairs;
  bool whole_cells = false;              // pairs take cells inside the domain as wholes
  std::vector<std::uint32_t> not_whole;  // ranks of cells that turned out to need their regions
  std::unique_ptr<Candidates> candidates;
  std::optional<ClipMemory> clip_memory;  // of the last pass, if it is little
  WallRows::Memory wall_memory;           // the same
  Timings timings;

  std::optional<Measures> measures;
  std::optional<Adjacency> adjacency;
  std::optional<Cells> cells;
  std::optional<Dual> dual;

  State(Device device, Domain domain, Options options);
  void forget_results();
  /// The seeds that may have cells: the pipeline works on their ranks.
  const SeedSet& contenders() const { return rest ? *rest : seeds; }
  /// Sets aside the seeds that are known to be hidden, if there are many. Tree and seeds are on the device
  /// afterwards.
  void sift(int threads);
  /// Tree and device buffers for the contenders.
  void upload(int threads);
  /// Tree, pairs, device buffers and candidate source for the present seeds and weights.
  /// \param want_regions  every cell is to be cut along the regions
  void prepare(bool want_regions);
  void find_pairs(bool want_regions);
  std::unique_ptr<Candidates> make_candidates() const;
  /// Whether whole cells tell the pairs, and their walls the candidates.
  bool cells_come_first(bool want_regions) const;
  void find_pairs_by_cells();
  /// Clips all pairs once; again where cells turn out to need their regions.
  void pass(bool want_adjacency, bool want_cells);
  /// Returns whether that was all.
  bool pass_once(bool want_adjacency, bool want_cells);
  /// Takes the weights of ranks so far down that nothing is left of their cells.
  void silence(std::span<const std::uint32_t> ranks);
  /// Throws unless the results keep their laws, and forgets them then.
  void certify();
  void log_run() const;
  /// Clips all pairs and fills measures, and adjacency and cells where asked.
  void run(bool want_adjacency, bool want_cells);
};

}  // namespace powercell
