/// \file
/// The cells of a diagram as one complex, in which neighbours have their points and walls in common.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/io/write/output.hpp"

namespace powercell::io {

/// Cell i owns the faces [face_offset[i], face_offset[i+1]); face f is loop[loop_offset[f] ..
/// loop_offset[f+1]), numbers of points, no two of which are the same in a row. What a face is follows
/// JoinedCells: rings in the plane, polygons in the triangles of a surface, the faces of polyhedra seen from
/// outside. In volumes a wall between two cells is one polygon, or several, with the same points in both: the
/// later cell has those of the earlier one the other way round, and `twin` is the other side. A vertex where
/// the cutting of the domain only split an edge is in all faces at that edge or in none.
struct SharedCells {
  int cell_dimension = 0;
  std::vector<double> points;              ///< rows of 3 (third coordinate 0 in the plane)
  std::vector<std::uint64_t> face_offset;  ///< n + 1
  std::vector<std::uint64_t> loop_offset;
  std::vector<std::uint32_t> loop;
  std::vector<Border> face_border;  ///< volumes
  std::vector<Border> edge_border;  ///< polygons and surfaces, per loop entry
  /// Parallel to the borders in a periodic domain, else empty, as in JoinedCells.
  std::vector<std::array<std::int32_t, 3>> shift;
  std::vector<std::uint64_t>
      twin;  ///< volumes, per face: the same face in the other cell; itself without one
  /// Why the cells do not fit together; empty if they do. They do with exact decisions in double precision.
  std::string fault;

  std::size_t cell_count() const { return face_offset.empty() ? 0 : face_offset.size() - 1; }
  std::size_t face_count() const { return loop_offset.empty() ? 0 : loop_offset.size() - 1; }
  std::size_t point_count() const { return points.size() / 3; }
  const double* point(std::uint32_t p) const { return &points[3 * std::size_t{p}]; }
  std::span<const std::uint32_t> face(std::uint64_t f) const {
    return std::span(loop).subspan(loop_offset[f], loop_offset[f + 1] - loop_offset[f]);
  }
  /// The points of a cell, each once, in the order in which its faces use them.
  std::vector<std::uint32_t> points_of(std::size_t cell) const;
};

/// \throw Error as share_points()
SharedCells share_cells(const DiagramOutput& output);

/// The joined cells, each with points of its own and without `twin`.
/// \param fault  kept
SharedCells separate_cells(const DiagramOutput& output, std::string fault);

/// As share_cells(), for a file that has no use for cells that do not fit together.
/// \throw Error write_failed (names the file, a seed and the way out)
SharedCells fitting_cells(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
