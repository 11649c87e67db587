/// \file
/// Variants of the kernels: the only place that names their defines and capacities.
#pragma once

#include <string>
#include <vector>

namespace powercell {

/// The largest cell that fits a kernel's private memory. A piece that does not fit is clipped again with the
/// next larger capacity, and finally on the host.
struct Capacity {
  int vertices;
  int faces;
};

/// The options that a kernel program is compiled with.
struct Variant {
  int dimension = 0;
  int cell_dimension = 0;
  bool float32 = false;
  Capacity capacity{};
  int lane_width = 8;  ///< 1, 4 or 8 (lib/cl/quirks.hpp)

  std::vector<std::string> defines() const;
};

/// The capacities for a cell dimension, smallest first.
/// 2D: white noise has 6 edges and seldom 14; a convex piece starts with up to 24.
/// 3D: white noise has 15.5 faces and 27 vertices, in 10^6 cells at most about 40 and 76.
const std::vector<Capacity>& capacities(int cell_dimension);

/// All variants of one precision and width of lanes, for tests that compile each.
std::vector<Variant> all_variants(bool float32, int lane_width);

}  // namespace powercell
