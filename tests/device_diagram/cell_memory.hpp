/// \file
/// The geometry of cells in device memory, and comparisons with that of a Diagram.
#pragma once

#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "tests/device_diagram/caller.hpp"

namespace powercell::test {

/// How many entries fit.
struct CellRoom {
  std::size_t pieces, vertices, faces, loop;
};
/// Enough for some more than `cells` has.
CellRoom room_of(const Cells& cells);

class CellMemory {
 public:
  CellMemory(const Caller& caller, Precision precision, const Domain& domain, std::size_t n, CellRoom room);
  static constexpr cl_uint unwritten = 0xfffffff0u;
  DeviceCells handles() const;
  /// Pieces, vertices, faces and entries of loops, as the device has counted them. Waits.
  std::vector<std::uint64_t> counts() const { return counts_.values<std::uint64_t>(caller_.queue(), 4); }
  std::vector<std::uint64_t> cell_offset() const {
    return cell_offset_.values<std::uint64_t>(caller_.queue(), n_ + 1);
  }
  /// The regions of all pieces that there is room for; `unwritten` where there is none.
  std::vector<cl_uint> regions() const { return region_.values<cl_uint>(caller_.queue(), room_.pieces); }
  /// The first `pieces`. Waits.
  Cells read(std::size_t pieces) const;
  Cells read() const { return read(counts()[0]); }

 private:
  const Caller& caller_;
  Precision precision_;
  bool volume_, periodic_;
  std::size_t dimension_, n_;
  CellRoom room_;
  std::vector<cl_uint> marks_;
  Memory counts_, cell_offset_, region_, vertex_offset_, vertices_, face_offset_, border_, shift_,
      loop_offset_, loop_;
};

/// The length, area or volume of cell i by its geometry, which is checked to be closed: each edge of a
/// polyhedron is in two faces, in opposite directions.
double measure_of_cell(const Cells& cells, std::size_t i);

/// Whether both have the same pieces with the same faces, and the same vertices to `error` in each
/// coordinate, in any order.
bool same_cell(const Cells& a, const Cells& b, std::size_t i, double error);
/// How far the cell reaches from the point.
double reach_of(const Cells& cells, std::size_t i, const double* point);

}  // namespace powercell::test
