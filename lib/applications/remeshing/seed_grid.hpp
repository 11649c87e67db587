/// \file
/// A search structure for seeds that supports insertion and removal.
#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "lib/applications/remeshing/vec.hpp"

namespace powercell::remeshing {

/// One grid of cubes per size class of seeds. A seed of size h is in the grid with cubes of a side in (2h,
/// 4h], so a cube holds few seeds if their spacing is about h, whatever the range of sizes.
class SeedGrid {
 public:
  /// \param size    spacing from other seeds, positive
  /// \param weight  the largest of a size class bounds its queries
  void insert(std::uint32_t id, Vec at, double size, double weight);
  /// \param at, size  as inserted
  void remove(std::uint32_t id, Vec at, double size);

  /// Calls `found(id)` for every seed within `radius(w)` of `centre` and some beyond, where w is the largest
  /// weight ever inserted in its size class.
  template <class Radius, class Found>
  void near(Vec centre, const Radius& radius, const Found& found) const {
    for (const auto& [exponent, level] : levels_)
      if (level.count > 0) near_in(level, centre, radius(level.most_weight), found);
  }

 private:
  struct Level {
    double side = 0, most_weight = 0;
    std::size_t count = 0;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cube;

    std::int64_t index(double x) const { return static_cast<std::int64_t>(std::floor(x / side)); }
    static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) {
      const auto part = [](std::int64_t x) { return static_cast<std::uint64_t>(x + (1 << 20)) & 0x1fffff; };
      return part(i) << 42 | part(j) << 21 | part(k);
    }
    std::uint64_t key(Vec at) const { return key(index(at.x), index(at.y), index(at.z)); }
  };

  template <class Found>
  static void near_in(const Level& level, Vec centre, double radius, const Found& found) {
    if (!(radius >= 0)) return;
    const double cubes = std::pow(2 * radius / level.side + 2, 3);
    if (!(cubes < static_cast<double>(level.cube.size()))) {  // visiting all is cheaper
      for (const auto& [key, ids] : level.cube)
        for (const std::uint32_t id : ids) found(id);
      return;
    }
    const auto low = [&](double x) { return level.index(x - radius); };
    const auto high = [&](double x) { return level.index(x + radius); };
    for (std::int64_t i = low(centre.x); i <= high(centre.x); ++i)
      for (std::int64_t j = low(centre.y); j <= high(centre.y); ++j)
        for (std::int64_t k = low(centre.z); k <= high(centre.z); ++k) {
          const auto at = level.cube.find(Level::key(i, j, k));
          if (at == level.cube.end()) continue;
          for (const std::uint32_t id : at->second) found(id);
        }
  }

  std::unordered_map<int, Level> levels_;
};

}  // namespace powercell::remeshing
