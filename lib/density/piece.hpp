/// \file
/// A convex piece of a cell as integration sees it. Internal.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>

#include "lib/density/model.hpp"

namespace powercell {

inline Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Integrals over one cell, about its seed.
struct Moments {
  double mass = 0, second = 0;
  Point first{};
  double error = 0;   ///< estimate of what adaptive rules left in the mass
  bool jump = false;  ///< the density has a jump there, as far as was seen
};

/// View of piece `index` of some cells.
class Piece {
 public:
  Piece(const Cells& cells, std::uint64_t index)
      : cells_(cells),
        first_(cells.vertex_offset[index]),
        end_(cells.vertex_offset[index + 1]),
        first_face_(cells.face_offset[index]),
        end_face_(cells.face_offset[index + 1]),
        region_(cells.region[index]) {}

  std::uint32_t region() const { return region_; }
  bool solid() const { return cells_.cell_dimension == 3; }
  std::uint64_t vertex_count() const { return end_ - first_; }
  std::uint64_t first_face() const { return first_face_; }
  std::uint64_t end_face() const { return end_face_; }
  const Border& border(std::uint64_t face) const { return cells_.border[face]; }

  Point vertex(std::uint64_t k) const {
    const auto d = static_cast<std::uint64_t>(cells_.dimension);
    const double* x = &cells_.vertices[(first_ + k) * d];
    return {x[0], x[1], d == 3 ? x[2] : 0.0};
  }
  /// Corners of a face: two in order for an edge, a polygon for a solid.
  std::uint64_t corner_count(std::uint64_t face) const {
    return solid() ? cells_.loop_offset[face + 1] - cells_.loop_offset[face] : 2;
  }
  /// Place of corner k of a face among the vertices of the piece.
  std::uint64_t corner(std::uint64_t face, std::uint64_t k) const {
    if (solid()) return cells_.loop[cells_.loop_offset[face] + k];
    return (face - first_face_ + k) % vertex_count();
  }

 private:
  const Cells& cells_;
  std::uint64_t first_, end_, first_face_, end_face_;
  std::uint32_t region_;
};

}  // namespace powercell
