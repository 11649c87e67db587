/// \file
/// Laws of joined cells on all domains.
#pragma once

#include <powercell/diagram.hpp>

namespace powercell::test {

/// A view of cell i of joined cells.
struct JoinedCell {
  JoinedCell(const JoinedCells& cells, std::size_t i) : cells(cells), i(i) {}
  std::size_t vertex_count() const { return cells.vertex_offset[i + 1] - cells.vertex_offset[i]; }
  std::size_t face_count() const { return cells.face_offset[i + 1] - cells.face_offset[i]; }
  std::size_t corner_count(std::size_t f) const { return end(f) - begin(f); }
  std::uint64_t begin(std::size_t f) const { return cells.loop_offset[cells.face_offset[i] + f]; }
  std::uint64_t end(std::size_t f) const { return cells.loop_offset[cells.face_offset[i] + f + 1]; }
  /// Signed area of ring f (polygons).
  double ring_area(std::size_t f) const;
  /// By the divergence theorem (polygon, volume), or the sum of the faces (surface).
  double measure() const;

  const JoinedCells& cells;
  std::size_t i;
};

/// The measure of the pieces of cell i.
double pieces_measure(const Cells& cells, std::size_t i);

/// Checks that each cell has the measure of its pieces to within `tolerance`, every vertex is used, every
/// index is in range, no loop repeats a vertex, and in volumes each edge occurs once in each direction.
void check_join_laws(const Domain& domain, const Cells& cells, const JoinedCells& joined, double tolerance);

/// The number of edges (polygon, surface) or faces (volume) that still have an interior border.
std::size_t interior_count(const JoinedCells& joined);

}  // namespace powercell::test
