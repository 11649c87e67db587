/// \file
/// Options of a diagram; the defaults suit most callers.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

namespace powercell {

enum class Precision {
  automatic,  ///< double where the device has it, else float
  float64,
  float32,
};

/// Where candidate neighbours come from. The cells are the same.
enum class Neighbors {
  automatic,  ///< tree
  tree,       ///< a packed tree with largest weights, searched in the kernel: any weights, any distribution
  flann,      ///< the paper's method: k nearest lifted neighbours of the twin, from a KD-tree on the host
};

/// How to treat cells whose shape rounding may have decided: grids, cospherical seeds, walls in facets.
enum class Decisions {
  exact,  ///< decide again on the host with exact numbers; the positions of the seeds break ties
  fast,   ///< keep them, and count them (Timings::uncertain)
};

struct Options {
  Precision precision = Precision::automatic;
  Decisions decisions = Decisions::exact;
  /// Check each result by laws that need no reference (sum of the measures, both sides of walls, owners of
  /// random points) and throw Error internal, naming the seeds, if one does not hold. Costs a few percent.
  bool certify = false;
  Neighbors neighbors = Neighbors::automatic;

  /// FLANN only: length of the first neighbour lists, doubled for cells that have not met the stopping rule.
  /// 0 means 16 for polygons and surfaces, 32 for volumes (the paper's Fig. 4).
  int initial_neighbors = 0;
  /// FLANN only: the height eta of the lift h_i = sqrt(eta - w_i) (paper, Fig. 3).
  /// NaN means the largest weight, which is the least eta allowed; eta may be as large as a weight may be.
  double lift_eta = std::numeric_limits<double>::quiet_NaN();
  /// FLANN only: query with the twin (p_i, -h_i) instead of the lifted seed (paper, Fig. 6).
  bool twin_queries = true;

  /// Host threads, for trees, collection and exact decisions; 0 means all.
  int threads = 0;
  /// The most (region, seed) pairs in device memory at once; 0 lets the library choose. Results do not depend
  /// on it, bit for bit.
  std::uint64_t chunk_pairs = 0;

  /// Called from time to time with the fraction done in [0, 1], which never falls within a computation;
  /// returning false stops the computation with Error interrupted.
  std::function<bool(double)> progress;
};

}  // namespace powercell
