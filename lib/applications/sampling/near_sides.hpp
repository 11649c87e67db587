/// \file
/// Sides of a surface that face each other.
#pragma once

#include <cstdint>
#include <memory>
#include <powercell/regions.hpp>
#include <vector>

#include "lib/base/box_tree.hpp"
#include "lib/base/vectors.hpp"

namespace powercell {

/// The surface in a ball about one of its points.
struct NearSides {
  /// Regions connected with the point's region within the ball that come within half the radius.
  std::vector<std::uint32_t> own;
  std::vector<std::uint32_t> opposite;  ///< other regions that lie above or below the point
};

/// Searches for sides. Not thread-safe: each thread has its own, a copy.
class NearSidesSearch {
 public:
  explicit NearSidesSearch(const Domain& surface);

  /// \return no `own` regions if there are no opposite ones
  NearSides around(const RegionPoint& point, double radius);

 private:
  using Vec = Vector3<double>;
  Vec corner(std::uint32_t region, std::uint32_t k) const;
  std::array<Vec, 3> triangle(std::uint32_t region) const;
  std::vector<std::uint32_t> connected(const RegionPoint& point, double radius);

  RegionsView mesh_;
  std::shared_ptr<const BoxTree> boxes_;
  std::vector<std::uint32_t> last_seen_;  // per region: the last search that found it connected
  std::uint32_t search_ = 0;
};

}  // namespace powercell
