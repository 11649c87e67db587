/// \file
/// Options of a diagram; every default is what most callers want.
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

/// Where candidate neighbours come from. The cells do not depend on it.
enum class Neighbors {
  automatic,  ///< tree
  tree,       ///< packed tree with largest weights, searched in the kernel: any weights, any distribution
  flann,      ///< the paper's: k nearest lifted neighbours of the twin, from a KD-tree on the host
};

/// What becomes of cells whose shape rounding may have decided: grids, cospherical seeds, walls in facets.
enum class Decisions {
  exact,  ///< decided anew on the host with exact numbers, ties broken by the positions of the seeds
  fast,   ///< left as they are, and counted (Timings::uncertain)
};

struct Options {
  Precision precision = Precision::automatic;
  Decisions decisions = Decisions::exact;
  /// Check each result by laws that need no reference (sum of the measures, both sides of walls, owners of
  /// random points) and throw Error internal, naming the seeds concerned, if one does not hold. Costs a few
  /// percent.
  bool certify = false;
  Neighbors neighbors = Neighbors::automatic;

  /// FLANN only: neighbours asked for at first, doubled for the cells that have not met the stopping
  /// rule. 0 means 16 for polygons and surfaces, 32 for volumes (the paper's Fig. 4).
  int initial_neighbors = 0;
  /// FLANN only: the height eta of the lift h_i = sqrt(eta - w_i) (paper, Fig. 3).
  /// NaN means the largest weight, the least eta allowed; the largest is the largest weight allowed.
  double lift_eta = std::numeric_limits<double>::quiet_NaN();
  /// FLANN only: query with the twin (p_i, -h_i) instead of the lifted seed (paper, Fig. 6).
  bool twin_queries = true;

  /// Host threads for trees and the last resort; 0 means all.
  int threads = 0;
  /// Most (region, seed) pairs in device memory at once; 0 means by the device's memory.
  /// Results do not depend on it, bit for bit.
  std::uint64_t chunk_pairs = 0;

  /// Called from time to time with the fraction done in [0, 1]; returning false stops the
  /// computation with Error interrupted.
  std::function<bool(double)> progress;
};

}  // namespace powercell
