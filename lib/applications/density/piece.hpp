/// \file
/// Cells as integration sees them: convex pieces within the box of the domain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <powercell/regions.hpp>
#include <powercell/results.hpp>

#include "lib/applications/density/model.hpp"
#include "lib/base/vectors.hpp"

namespace powercell {

/// Integrals over one cell: of the density, of x times it and of |x|² times it, x relative to the origin.
struct Moments {
  Point origin{};
  double mass = 0, second = 0;
  Point first{};
  double error = 0;   ///< estimated quadrature error of the mass
  bool jump = false;  ///< a jump of the density was found in the cell
};

/// The bounding box of a domain; in 2D the third coordinates are 0.
struct DomainBox {
  Point low{}, high{};
  explicit DomainBox(const Domain& domain) : low(domain.low()), high(domain.high()) {}
};

/// View of piece `index` of some cells, with its vertices clamped to the box: if a seed is very far away, the
/// rounding of its distance may put them anywhere, and a piece larger than the domain takes long to
/// integrate.
class Piece {
 public:
  Piece(const Cells& cells, const DomainBox& box, std::uint64_t index)
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
  /// Number of corners of a face: 2 for an edge of a polygon; the face of a solid is a polygon.
  std::uint64_t corner_count(std::uint64_t face) const {
    return solid() ? cells_.loop_offset[face + 1] - cells_.loop_offset[face] : 2;
  }
  /// Index of corner k of a face among the vertices of the piece.
  std::uint64_t corner(std::uint64_t face, std::uint64_t k) const {
    if (solid()) return cells_.loop[cells_.loop_offset[face] + k];
    return (face - first_face_ + k) % vertex_count();
  }

 private:
  double within(double x, std::size_t axis) const { return std::clamp(x, box_.low[axis], box_.high[axis]); }

  const Cells& cells_;
  const DomainBox& box_;
  std::uint64_t first_, end_, first_face_, end_face_;
  std::uint32_t region_;
};

/// The regions of a domain as cells of one piece each, so that code for cells also integrates over the
/// domain.
Cells region_cells(const RegionsView& mesh);

}  // namespace powercell
