/// \file
/// The convex regions of a domain: convex pieces of a polygon, triangles of a surface, tetrahedra of a
/// volume.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <span>
#include <vector>

namespace powercell {

enum class RegionShape {
  polygon,      ///< convex, vertices counter-clockwise (surface: a triangle as oriented)
  tetrahedron,  ///< positively oriented: det(v1-v0, v2-v0, v3-v0) > 0
  box,          ///< 8 corners, corner k at (x: k&1, y: k&2, z: k&4), low where the bit is 0
};

/// A view of the regions; the domain and its copies own the arrays.
/// Region r has the vertices region_vertex[region_offset[r] .. region_offset[r+1]) and the facets
/// [facet_offset[r], facet_offset[r+1]): of a polygon, edge k from its vertex k to vertex k+1; of a
/// tetrahedron, facet k opposite vertex k; of a box, -x +x -y +y -z +z.
struct RegionsView {
  RegionShape shape = RegionShape::polygon;
  int dimension = 0;                             ///< coordinates of a vertex
  int cell_dimension = 0;                        ///< 2 or 3
  std::span<const double> vertices;              ///< nv x dimension, row-major
  std::span<const std::uint32_t> region_offset;  ///< regions + 1
  std::span<const std::uint32_t> region_vertex;  ///< indices of vertices
  std::span<const std::uint32_t> facet_offset;   ///< regions + 1
  /// Per facet: a boundary facet and its number, or interior and the region behind it. Edges between convex
  /// pieces of a polygon, and edges that triangles share, are interior.
  std::span<const Border> facet;
  std::span<const std::uint32_t> source;  ///< per region: the input part, triangle or tetrahedron
  std::uint32_t boundary_count = 0;       ///< boundary facets

  std::size_t size() const { return source.size(); }
};

/// A point of a domain and the region that it lies in.
struct RegionPoint {
  std::uint32_t region = 0;       ///< 0 in a solid
  std::array<double, 3> point{};  ///< third coordinate 0 in 2D
};

/// Points uniform in area or volume; the same ones for the same random seed on every machine.
/// \throw Error unsupported for a solid that fills less than a millionth of its bounding box
POWERCELL_API std::vector<RegionPoint> random_points(const Domain& domain, std::size_t count,
                                                     std::uint64_t random_seed);

}  // namespace powercell
