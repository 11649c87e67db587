/// \file
/// Convex polygons in space and convex polyhedra, cut by bisectors, for the peers. Coordinates are relative
/// to a seed. A border is a facet of the region (0 to 3) or, from `first_link` on, a bisector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/base/vectors.hpp"

namespace powercell::bench {

using Vec3 = Vector3<double>;
inline constexpr std::uint32_t first_link = 4;

enum class Cut { untouched, smaller, nothing_left };

/// A triangle, then what the cuts leave of it.
class PolygonPiece {
 public:
  void start(const Vec3* corners);
  /// Keeps the points y with q . y <= offset; the new edge has the given border.
  Cut cut(const Vec3& q, double offset, std::uint32_t border);
  double largest_square() const;  ///< largest squared distance of a point of the piece from the seed
  double measure() const;
  /// Appends the borders of the piece.
  void borders(std::vector<std::uint32_t>& list) const;

 private:
  struct Corner {
    Vec3 at;
    std::uint32_t border;  ///< of the edge to the next corner
  };
  std::vector<Corner> ring_, kept_;
  std::vector<double> excess_;
};

/// A tetrahedron, then what the cuts leave of it, as a graph in which every vertex has three edges.
class PolyhedronPiece {
 public:
  /// The tetrahedron may have either orientation.
  void start(const Vec3* corners);
  /// \throw std::runtime_error if rounding makes the cut inconsistent
  Cut cut(const Vec3& q, double offset, std::uint32_t border);
  double largest_square() const;
  double measure();
  void borders(std::vector<std::uint32_t>& list) const;

 private:
  /// Edge e goes to vertex `to[e]` and has the face `left[e]` on its left, seen from outside. Each of the
  /// three faces at a vertex is to the left of one edge.
  struct Vertex {
    Vec3 at;
    std::array<std::uint32_t, 3> to, left;
  };
  void link_new_vertices(std::size_t first, std::uint32_t face);
  void drop_cut_vertices(std::size_t old_count);

  std::vector<Vertex> vertices_;
  std::vector<double> excess_;
  std::vector<std::uint32_t> border_;   ///< per face, including faces cut off
  std::vector<std::uint32_t> right_;    ///< per new vertex: the face to the right of the edge that it lies on
  std::vector<std::uint32_t> of_face_;  ///< a vertex of each face, or `none`
  std::vector<std::uint32_t> renumbered_;
};

}  // namespace powercell::bench
