/// \file
/// VTK's XML formats.
#pragma once

#include <string>

#include "apps/io/output.hpp"

namespace powercell::io {

/// Unstructured grid of the convex pieces of the cells, one for each region a cell meets: VTK_POLYGON
/// on polygons and surfaces, VTK_POLYHEDRON in volumes. Cell data: `seed`, `region`, `weight`,
/// `measure` (of the whole cell), `piece_measure`. In volumes ordered by the number of vertices.
/// \throw Error write_failed
void write_vtu(const std::string& path, const DiagramOutput& output);

/// Polygons: the convex pieces of the cells, in volumes the faces of the joined cells. Cell data:
/// `seed`, `weight`, `measure` (of the whole cell), in volumes `neighbor` (-1 at the domain's
/// boundary). \throw Error write_failed
void write_vtp(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
