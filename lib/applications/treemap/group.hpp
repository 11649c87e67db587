/// \file
/// One group of siblings in its parent's polygon.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <powercell/treemap.hpp>
#include <vector>

#include "lib/applications/treemap/convex_diagram.hpp"

namespace powercell::treemap_detail {

/// The input of a layout, in the coordinates of GroupFrame: area 1, centroid at the origin.
struct Group {
  Columns outline;            ///< convex, counter-clockwise
  std::vector<double> share;  ///< per child: its area, above 0; sum 1; at least two children
  Columns start;              ///< per child: earlier seed, NaN for a new child; empty if all are new
  std::uint64_t random_seed = 0;
};

/// The result, in the same coordinates.
struct GroupLayout {
  std::vector<std::uint64_t> offset;  ///< children + 1: polygon i has the vertices [offset[i], offset[i+1])
  std::vector<double> vertices;       ///< x, y pairs
  Columns seeds;                      ///< per child
  bool converged = false;
  std::uint64_t diagrams = 0, newton_steps = 0;
};

struct GroupSettings {
  int rounds = 25;
  double tolerance = 1e-6;
};

/// Lays out groups one after the other on the calling thread, reusing its memory. Not thread-safe.
class GroupSolver {
 public:
  GroupSolver();
  ~GroupSolver();
  GroupSolver(GroupSolver&&) noexcept;
  GroupLayout lay_out(const Group& group, const GroupSettings& settings);

 private:
  struct HostSolver;
  std::unique_ptr<HostSolver> solver_;
};

/// The same by TransportSolver on a device, for any number of siblings.
/// \param progress  called after each step with the fraction done; returning false stops with Error
/// interrupted
GroupLayout lay_out_large(const Group& group, const GroupSettings& settings, const Device& device,
                          int threads, const std::function<bool(double)>& progress);

}  // namespace powercell::treemap_detail
