/// \file
/// The polygons of a diagram in space, the common input of the mesh formats.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/io/write/output.hpp"

namespace powercell::io {

/// Polygons ordered by cell. Polygon p has the corners corner[offset[p] .. offset[p+1]), indices from
/// 0 into the rows of `vertices`.
struct PolygonSoup {
  std::vector<double> vertices;       ///< nv x 3 (third coordinate 0 for polygon domains)
  std::vector<std::uint64_t> offset;  ///< polygons + 1
  std::vector<std::uint64_t> corner;
  std::vector<std::uint32_t> seed;     ///< per polygon: its cell
  std::vector<std::int64_t> neighbor;  ///< per polygon: the seed behind the wall (volumes), or -1
  std::vector<std::int64_t> facet;     ///< per polygon: the domain's facet that it lies in (volumes), or -1
  std::size_t size() const { return seed.size(); }
  std::size_t vertex_count() const { return vertices.size() / 3; }
};

/// Polygon and surface domains: the convex pieces of the cells, since these formats have no holes.
/// Volumes: the faces of the joined cells, each seen from outside its cell.
PolygonSoup polygon_soup(const DiagramOutput& output);

}  // namespace powercell::io
