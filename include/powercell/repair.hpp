/// \file
/// Repair of triangle meshes: faults of files that a surface has although its shape is right.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <powercell/export.hpp>
#include <powercell/shapes.hpp>
#include <span>
#include <string>
#include <vector>

namespace powercell {

struct RepairOptions {
  /// Edges of the boundary whose ends are up to this far apart are joined, but never ends farther apart than
  /// a quarter of the shortest edge there. 0: edges at the same position only. Below 0: 10^-6 of the diagonal
  /// of the mesh, or four times the rounding of coordinates if that is more. That rounding is a decimal place
  /// if all coordinates end there and the diagonal has more than 10^5 of them; or that of single precision if
  /// all are single-precision numbers; else that of double; at most 10^-3 of the diagonal.
  double weld = -1;
};

/// How often something was done or found, and a place of the first time.
struct RepairCount {
  std::size_t count = 0;
  std::array<double, 3> first{};
};

/// What was done to a mesh, in this order, and what was left.
struct POWERCELL_API RepairReport {
  RepairCount degenerate;  ///< triangles with two corners at one position, removed
  /// Triangles with the corners of an earlier one, removed, unless that opens a closed part.
  RepairCount repeated;
  RepairCount split_edges;     ///< edges of more than two triangles, split into edges of two or one
  RepairCount split_vertices;  ///< vertices where sheets touch, split into one for each sheet
  RepairCount welded;          ///< pairs of boundary edges that are a little apart, joined
  double moved = 0;            ///< the farthest that welding moved a vertex
  RepairCount turned;          ///< triangles turned, as their part is oriented otherwise
  RepairCount flat;            ///< triangles without area, removed by flips and collapses of edges

  RepairCount left_flat;      ///< triangles without area that could not be removed
  RepairCount intersections;  ///< pairs of triangles that cross each other
  std::size_t components = 0;
  std::size_t boundary_edges = 0;

  bool changed() const;                   ///< whether anything was done
  std::vector<std::string> acts() const;  ///< what was done, a sentence for each kind
  std::vector<std::string> left() const;  ///< what was left
};

struct RepairedMesh {
  TriangleMesh mesh;  ///< vertices keep their order; split ones are at the end
  RepairReport report;
};

/// Makes a mesh an oriented manifold with boundary, as far as nothing of its shape is lost: positions change
/// by the distance of welding and by the rounding of coordinates only.
///
/// Edges are joined by their vertices first, then by position. So vertices at the same position are one where
/// triangles with vertices of their own meet at an edge, as in STL, but solids that only touch stay apart.
/// Of several triangles at an edge those are joined that enclose the inside between them.
/// \param vertices   nv x 3, row-major
/// \param triangles  nt x 3 vertex indices from 0
/// \throw Error invalid_domain (sizes, indices and coordinates that Domain::surface refuses; all triangles
///   degenerate), invalid_argument (a tolerance that is not a number)
POWERCELL_API RepairedMesh repair(std::span<const double> vertices, std::span<const std::uint32_t> triangles,
                                  const RepairOptions& options = {});

}  // namespace powercell
