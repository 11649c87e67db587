/// \file
/// A diagram as Gmsh sees it: points, curves, surfaces and volumes, each with its mesh.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "apps/io/write/output.hpp"

namespace powercell::io {

struct GmshEntity {
  std::uint64_t tag = 0;
  std::uint64_t group = 0;              ///< physical; 0 for none
  std::vector<std::int64_t> bounds;     ///< tags of the entities around it, signed
  std::vector<std::uint32_t> nodes;     ///< points that lie in no entity of a lower dimension
  std::vector<std::uint32_t> elements;  ///< points of its lines or triangles
};

struct GmshModel {
  std::vector<double> points;                                  ///< rows of 3
  std::array<std::vector<GmshEntity>, 4> entities;             ///< by dimension
  std::array<std::map<std::uint64_t, std::string>, 4> groups;  ///< by dimension: names of physical groups
};

/// Of a volume: all corners, edges, walls and cells; walls have triangles, and cells no elements, so that
/// Gmsh fills them. Of a polygon or surface: the walls as lines and the cells as triangles, fans in their
/// pieces. Groups: each cell, the walls, and the boundary: its facets, or all of it where they are elements
/// of a mesh.
/// \throw Error write_failed if the cells do not fit together (names the file)
GmshModel gmsh_model(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
