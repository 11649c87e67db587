/// \file
/// Convex polygons in space and convex polyhedra that are cut by bisectors, fast, for the peers. Coordinates
/// are relative to a seed. A border is a facet of the region (0 to 3) or, from `first_link` on, a bisector.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace powercell::bench {

using Vec3 = std::array<double, 3>;
inline constexpr std::uint32_t first_link = 4;

enum class Cut { untouched, smaller, nothing_left };

/// A triangle and what is left of it.
class PolygonPiece {
 public:
  void start(const Vec3* corners);
  /// Keeps q . y <= offset.
  Cut cut(const double* q, double offset, std::uint32_t border);
  double largest_square() const;  ///< of the distance of a point of the piece from the seed
  double measure() const;
  /// The borders that are left are appended.
  void borders(std::vector<std::uint32_t>& list) const;

 private:
  struct Corner {
    Vec3 at;
    std::uint32_t border;  ///< of the edge to the next corner
  };
  std::vector<Corner> ring_, kept_;
  std::vector<double> excess_;
};

/// A tetrahedron and what is left of it, as a graph in which every vertex has three edges.
class PolyhedronPiece {
 public:
  /// In either orientation.
  void start(const Vec3* corners);
  /// \throw std::runtime_error when rounding made the cut contradict itself
  Cut cut(const double* q, double offset, std::uint32_t border);
  double largest_square() const;
  double measure();
  void borders(std::vector<std::uint32_t>& list) const;

 private:
  /// Edge e goes to vertex `to[e]` and has the face `left[e]` on its left, seen from outside. Each of the
  /// three faces at a vertex is the left one of one edge.
  struct Vertex {
    Vec3 at;
    std::array<std::uint32_t, 3> to, left;
  };
  void link_new_vertices(std::size_t first, std::uint32_t face);
  void drop_cut_vertices(std::size_t old_count);

  std::vector<Vertex> vertices_;
  std::vector<double> excess_;
  std::vector<std::uint32_t> border_;  ///< per face, also of those that are gone
  std::vector<std::uint32_t>
      right_;  ///< of each new vertex: the face on the right of the edge it was made on
  std::vector<std::uint32_t> of_face_;  ///< a vertex of each face; `none` where there is none
  std::vector<std::uint32_t> renumbered_;
};

}  // namespace powercell::bench
