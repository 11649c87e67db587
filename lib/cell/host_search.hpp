/// \file
/// The seeds whose bisectors may cut a cell, nearest bisector first, from the packed tree.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lib/cell/host_clip.hpp"
#include "lib/cell/host_plane.hpp"

namespace powercell {

/// Searches outwards in rounds. Each round finds the seeds with bisectors nearer than a horizon and leaves
/// out those that clear the cell by a margin (docs/mathematics.md, "Certain decisions").
class HostSearch {
 public:
  explicit HostSearch(const HostScene& scene) : scene_(scene) {}

  /// Starts the search for the cell of seed `rank`. Fast if the seed before was of the same leaf.
  void start(std::uint32_t rank);
  /// The next seed, or nothing if no other seed can cut the cell, or if it gave up.
  /// \param radius    no vertex of the cell is farther from its seed
  /// \param vertices  vertices() lists them
  template <class Vertices>
  std::optional<std::uint32_t> next(double radius, const Vertices& vertices) {
    const double reach = 4 * (1 + search_margin / 4) * radius * radius;
    while (queue_.empty() && horizon_ < reach && !gave_up()) advance(vertices(), radius, reach);
    if (queue_.empty() || !(queue_.back().key < reach) || gave_up()) return {};
    const std::uint32_t seed = queue_.back().at;
    queue_.pop_back();
    ++effort_;
    return seed;
  }
  /// Whether it went through so many nodes and seeds that a search for each vertex is better.
  bool gave_up() const { return effort_ > effort_most; }

 private:
  /// White noise takes some 100.
  static constexpr std::size_t effort_most = 256;
  /// A seed is left out only if it clears the cell by 1/16 of this part of its radius.
  static constexpr double search_margin = 1.0 / (1 << MARGIN_BITS_DOUBLE);
  static constexpr std::int32_t seed_level = -1, rest_level = -2;

  /// A seed, a node of the tree (from level 0), or all of `rest_`.
  struct Entry {
    double key;  ///< lower bound of the signed squares of twice the distances (4) of its bisectors
    std::uint32_t at;
    std::int32_t level;
  };
  using Entries = std::vector<Entry>;

  HostNode box_of(const Entry& entry) const;
  double key_of(double nearest, double farthest, double weight) const;
  void divide_tree(std::uint32_t leaf);
  void advance(const std::vector<Point>& cell, double radius, double reach);
  static void take_below(double limit, double reach, Entries& from, Entries& taken);
  void open(const Entry& entry, double reach);
  void keep_cutting(Entries& entries, const std::vector<Point>& cell, double radius);

  const HostScene& scene_;
  std::uint32_t rank_ = 0;
  std::array<double, 4> seed_{};
  double horizon_ = 0;
  std::size_t effort_ = 0;  ///< nodes opened and seeds found
  Entries nodes_, seeds_;   ///< beyond the horizon
  Entries queue_;           ///< seeds within it, the nearest last
  // The leaves near the leaf of the seed, and nodes that hold all others; keys: squared distances.
  std::uint32_t home_ = ~std::uint32_t{0};
  Entries near_, rest_;
  double near_distance_ = 0, rest_weight_ = 0;
  // For keep_cutting.
  std::vector<double> box_, least_, most_;
};

}  // namespace powercell
