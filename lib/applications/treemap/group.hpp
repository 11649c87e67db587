/// \file
/// One group of siblings in its parent's polygon. Internal.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <powercell/treemap.hpp>
#include <vector>

#include "lib/applications/treemap/convex_diagram.hpp"

namespace powercell::treemap_detail {

/// What is to be laid out, in the group's frame (GroupFrame): area 1, centroid at 0.
struct Group {
  Columns outline;            ///< convex, counter-clockwise
  std::vector<double> share;  ///< per child, above 0, of sum 1; two at least
  Columns start;              ///< per child; NaN where the child is new. Empty: all are
  std::uint64_t random_seed = 0;
};

struct GroupLayout {
  std::vector<std::uint64_t> offset;  ///< children + 1
  std::vector<double> vertices;       ///< x, y pairs
  Columns seeds;                      ///< children
  bool converged = false;
  std::uint64_t diagrams = 0, newton_steps = 0;
};

struct GroupSettings {
  int rounds = 25;
  double tolerance = 1e-6;
};

/// Lays out groups one after the other on the calling thread; keeps its memory. Not thread-safe.
class GroupSolver {
 public:
  GroupSolver();
  ~GroupSolver();
  GroupSolver(GroupSolver&&) noexcept;
  GroupLayout lay_out(const Group& group, const GroupSettings& settings);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The same for any number of siblings, by TransportSolver on a device.
/// \param go_on  asked after each step; false stops with Error interrupted
GroupLayout lay_out_large(const Group& group, const GroupSettings& settings, const Device& device,
                          int threads, const std::function<bool()>& go_on);

}  // namespace powercell::treemap_detail
