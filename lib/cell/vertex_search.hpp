/// \file
/// The seed that takes a vertex from a cell, for cells that many seeds come near without cutting them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/base/two_doubles.hpp"
#include "lib/cell/host_clip.hpp"
#include "lib/cell/host_plane.hpp"

namespace powercell {

/// Finds the seed of least power distance from a vertex. Thousands of seeds may be equally near, to rounding
/// (docs/mathematics.md (86b)). Each search leaves bounds in the nodes of the tree for the next one: of seeds
/// on a circle, the first search goes through all and later ones through few. Each thread needs its own.
/// \tparam Real  double or TwoDoubles
template <class Real>
class VertexSearch {
 public:
  using Vector = std::array<Real, 3>;

  explicit VertexSearch(const HostScene& scene)
      : scene_(scene), dimension_(static_cast<std::size_t>(scene.mesh->dimension)) {}

  /// From now on vertices are relative to seed `rank`.
  void start(std::uint32_t rank);
  /// A seed that is nearer to the vertex than the cell's own, beyond doubt. Without one, doubtful() lists the
  /// seeds that rounding does not tell from the cell's own.
  /// \param vertex  relative to the cell's seed
  /// \param error   at least the distance of the vertex from its true place
  /// \param most    the search ends early once doubtful() has more seeds than this
  std::optional<std::uint32_t> find(const Vector& vertex, double error, std::size_t most);
  const std::vector<std::uint32_t>& doubtful() const { return doubtful_; }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// A vertex of an earlier search, as it was given, and the seed that it was relative to.
  struct Place {
    Point seed;
    Vector vertex;
  };
  /// No seed of a node has a smaller |p_j - x|^2 + W - w_j, W being the largest weight of the node and x a
  /// place.
  struct Known {
    std::uint32_t place = none;
    Real least{};
  };
  /// Of the difference of power distances at the vertex as given, over the seeds of a node.
  struct Bound {
    Real least{};
    double far = 0;  ///< no seed is farther from the cell's own (sum of coordinates)
  };
  struct Child {
    Bound bound;
    std::uint32_t at = 0;
  };

  std::size_t number(std::uint32_t at, std::size_t level) const {
    return scene_.tree->level_offset[level] + at;
  }
  /// Whether no seed below the node takes the vertex, or is as near as one that was found.
  bool is_clear(const Bound& bound) const;
  bool ended_early() const { return !nearest_ && doubtful_.size() > most_; }
  Bound bound(std::size_t number) const;
  Real bound_by_place(const HostNode& node, const Known& known, double squares) const;
  Real search(std::uint32_t at, std::size_t level);
  Real search_children(std::uint32_t at, std::size_t level);
  Real search_leaf(std::uint32_t at);

  const HostScene& scene_;
  const std::size_t dimension_;
  std::uint32_t rank_ = 0;
  std::array<double, 4> seed_{};
  Vector vertex_{};
  Real square_{};  ///< |vertex|^2
  double error_ = 0;
  std::size_t most_ = 0;
  double best_ = 0;  ///< of the differences of seeds beyond doubt
  std::optional<std::uint32_t> nearest_;
  std::vector<std::uint32_t> doubtful_;
  std::vector<Place> places_;
  std::vector<Known> known_;  ///< per node of the tree
};

extern template class VertexSearch<double>;
extern template class VertexSearch<TwoDoubles>;

}  // namespace powercell
