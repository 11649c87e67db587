/// \file
/// The part of one cell that lies in a solid, from the whole cell and its pieces on the solid's boundary.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lib/base/vectors.hpp"

namespace powercell::solid {

inline constexpr std::uint32_t none = ~std::uint32_t{0};

class Lookup {
 public:
  void clear() {
    row_.clear();
    if (!table_.empty()) table_.clear();
  }
  /// Adds a key, which must be new.
  void add(std::uint64_t key, std::uint32_t value) {
    row_.emplace_back(key, value);
    if (row_.size() == few) table_.insert(row_.begin(), row_.end());
    if (row_.size() > few) table_.emplace(key, value);
  }
  /// The value of a key, or `none`.
  std::uint32_t find(std::uint64_t key) const {
    if (row_.size() < few) {
      for (const auto& [k, value] : row_)
        if (k == key) return value;
      return none;
    }
    const auto found = table_.find(key);
    return found == table_.end() ? none : found->second;
  }

 private:
  static constexpr std::size_t few = 64;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> row_;
  std::unordered_map<std::uint64_t, std::uint32_t> table_;
};

using Point = Vector3<double>;

/// A convex polyhedron as in a row of PieceBatch, in coordinates relative to the seed: a 3-regular graph.
struct WholeCell {
  std::span<const std::int32_t> border;  ///< per face: the rank behind it, or below 0 for the clipping region
  std::span<const double> area;          ///< per face
  std::span<const double> vertex;        ///< 3 per vertex
  std::span<const std::uint32_t> link;   ///< 6 per vertex: neighbours and faces (kernels/layout.h)

  std::size_t vertices() const { return vertex.size() / 3; }
};

/// The part of a boundary triangle in the cell: a ring, counter-clockwise seen from outside the solid. Edge k
/// begins at vertex k.
struct BoundaryPiece {
  std::span<const std::int32_t> border;  ///< per edge: a rank, or ~k for edge k of the triangle
  std::span<const double> vertex;        ///< 3 per vertex
  std::span<const std::uint32_t> edges;  ///< numbers of the triangle's edges, the same in all triangles there
  std::uint32_t triangle = 0;
  std::span<const std::uint32_t> corners = {};  ///< numbers of the triangle's corners
};

/// Integrals over the part of a cell in the solid, about the seed, and its walls.
struct SolidPart {
  std::array<double, 5> moments{};       ///< measure, first moments, second moment
  std::vector<std::uint32_t> neighbors;  ///< of the walls
  std::vector<double> areas;             ///< of the walls
  /// Whether rounding may have changed the sign of the measure or of the area of a wall (12g).
  bool thin = false;
  /// Whether the part is no thicker than rounding. Walls that are not wider than rounding are left out.
  bool flat = false;
};

/// Whether a vertex of a cell lies in the solid.
enum class Side : std::int8_t { unknown = -1, outside = 0, inside = 1 };

/// Computes one cell after the other (docs/mathematics.md, "Solids by their boundary"). A thread needs one of
/// its own.
class CellInSolid {
 public:
  /// Keeps the views until the next call.
  /// \param seeds  positions by rank, for the normals of walls
  void start(std::uint32_t rank, const WholeCell& cell, std::span<const double> positions);
  void add(const BoundaryPiece& piece);
  /// The area of the piece added as number k.
  double piece_area(std::size_t k) const;

  /// Finds which vertices lie inside, from the crossings of edges with the boundary (12f).
  /// \return false if crossings contradict each other or the cell
  bool label();
  /// Whether no edge shows on which side its ends lie: then all vertices lie on the same side, which must
  /// come from elsewhere.
  bool uniform() const { return uniform_; }
  /// Sets the side of all vertices of a uniform cell.
  void set_sides(Side side);
  Side side(std::uint32_t vertex) const { return side_[vertex]; }
  /// Whether a vertex on the clipping region lies inside the solid: the cell is then incomplete.
  bool is_open() const;

  /// \pre label(), and set_sides() for a uniform cell
  SolidPart part();
  /// Whether the boundary meets face f.
  /// \pre part()
  bool is_cut(std::uint32_t f) const { return walls_[f].cut; }

  // What the surface of the part is made of (cell_faces.hpp). Edges of the cell are numbered 3 * vertex +
  // slot.
  struct RingVertex {
    Point at;
    std::uint32_t face;        ///< that the edge from here to the next one lies in, or none
    std::uint32_t edge_point;  ///< number of the point in which an edge of the boundary meets a wall, or none
  };
  /// Where the boundary crosses an edge of the cell, seen along the edge from its lower vertex.
  struct Crossing {
    std::uint32_t edge;  ///< from its lower vertex
    int leaves;          ///< 1 where the edge leaves the solid, -1 where it enters
    Point at;
  };
  const WholeCell& cell() const { return cell_; }
  std::span<const double> positions() const { return positions_; }
  std::uint32_t rank() const { return rank_; }
  /// The rings of all pieces, one after the other.
  const std::vector<RingVertex>& ring() const { return ring_; }
  std::size_t edge_points() const { return edge_point_.size(); }
  /// In the order of the ring vertices on them.
  /// \pre label()
  const std::vector<Crossing>& crossings() const { return crossings_; }
  Point vertex(std::uint32_t v) const {
    return {cell_.vertex[3 * std::size_t{v}], cell_.vertex[3 * std::size_t{v} + 1],
            cell_.vertex[3 * std::size_t{v} + 2]};
  }
  std::uint32_t next(std::uint32_t edge) const { return cell_.link[6 * (edge / 3) + edge % 3]; }
  std::uint32_t left(std::uint32_t edge) const { return cell_.link[6 * (edge / 3) + 3 + edge % 3]; }
  std::uint32_t right(std::uint32_t edge) const { return cell_.link[6 * (edge / 3) + 3 + (edge + 2) % 3]; }
  bool is_lower(std::uint32_t edge) const { return edge / 3 < next(edge); }

 private:
  /// Sums over the boundary of the part within one wall.
  struct Wall {
    bool cut = false;  // whether boundary pieces end in it
    Point base{};      // a point of its plane
    Point area{};      // twice the area, along the normal
    double extent = 0;
  };

  void number_edges();
  std::uint32_t edge_between(std::uint32_t left, std::uint32_t right) const;
  std::uint32_t opposite(std::uint32_t edge) const;  ///< the same edge from its other end
  bool find_crossings();
  /// Adds the ring vertex k if it lies on an edge of the cell.
  bool add_crossing(std::size_t before, std::size_t k);
  bool set_side(std::uint32_t vertex, Side side);
  bool spread();

  void add_pieces();
  void add_piece(std::size_t first, std::size_t last);
  void add_wall_edge(std::uint32_t f, const Point& from, const Point& to);
  void add_edges();
  /// Adds the triangle between the base of face f and the segment from a to b, `sign` times.
  void add_segment(std::uint32_t f, const Point& a, const Point& b, double sign);
  void add_edge_segment(std::uint32_t edge, const Point& a, const Point& b, double sign);
  /// Adds the tetrahedron between the origin and a triangle; all points are relative to the origin.
  void add_tetrahedron(const Point& a, const Point& b, const Point& c, double six_volumes);
  void finish_walls(SolidPart& part);
  void finish_moments(SolidPart& part) const;

  std::uint32_t rank_ = 0;
  WholeCell cell_;
  std::span<const double> positions_;
  std::vector<std::uint32_t> first_;  // per face: a vertex

  std::vector<RingVertex> ring_;
  std::vector<std::size_t> ring_end_;
  /// Where edges of the boundary meet walls. All triangles there must have the same point: of an edge that is
  /// nearly parallel to the wall, each places it differently along the edge.
  std::vector<Point> edge_point_;
  Lookup edge_point_number_;  // by edge and face
  bool unknown_border_ = false;

  Lookup face_number_;                      // by border
  std::vector<std::uint32_t> edge_number_;  // by left and right face
  Lookup edge_of_many_;                     // the same, of a cell with many faces
  std::vector<Crossing> crossings_;
  // Per edge, 3 * vertex + slot, so twice each: how often it leaves the solid more than it enters it.
  std::vector<int> net_;
  std::vector<Side> side_;
  std::vector<std::uint32_t> stack_;
  bool uniform_ = false;

  // Of part(). Points are relative to origin_, a point of the boundary.
  Point origin_{};
  std::vector<Wall> walls_;
  std::vector<std::uint32_t> base_;  // per edge: a crossing
  double six_volumes_ = 0, second_ = 0, extent_ = 0, reach_ = 0;
  Point first_moment_{};
};

}  // namespace powercell::solid
