/// \file
/// A convex piece of a cell as integration sees it. Internal.
#pragma once

#include <algorithm>
#include <cstdint>
#include <powercell/results.hpp>

#include "lib/applications/density/model.hpp"
#include "lib/base/vectors.hpp"

namespace powercell {

/// Integrals over one cell, about a point of it.
struct Moments {
  Point origin{};
  double mass = 0, second = 0;
  Point first{};
  double error = 0;   ///< estimate of what adaptive rules left in the mass
  bool jump = false;  ///< the density has a jump there, as far as was seen
};

/// The box around a domain; in 2D the third coordinates are 0.
struct Box {
  Point low{}, high{};
  explicit Box(const Domain& domain) : low(domain.low()), high(domain.high()) {}
};

/// View of piece `index` of some cells, whose vertices lie in the box: rounding of the distance to a seed
/// that is very far away would put them anywhere, and what is larger than the domain takes long to integrate.
class Piece {
 public:
  Piece(const Cells& cells, const Box& box, std::uint64_t index)
      : cells_(cells),
        box_(box),
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
    return {within(x[0], 0), within(x[1], 1), d == 3 ? within(x[2], 2) : 0.0};
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
  double within(double x, std::size_t axis) const { return std::clamp(x, box_.low[axis], box_.high[axis]); }

  const Cells& cells_;
  const Box& box_;
  std::uint64_t first_, end_, first_face_, end_face_;
  std::uint32_t region_;
};

}  // namespace powercell
