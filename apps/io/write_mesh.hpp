/// \file
/// Mesh formats that hold polygons: OBJ, PLY, OFF. All hold a polygon soup: corners are not shared
/// between cells, so that a program may move cells apart.
#pragma once

#include <string>

#include "apps/io/output.hpp"

namespace powercell::io {

/// Each cell is a group `cell_<seed>`. \throw Error write_failed
void write_obj(const std::string& path, const DiagramOutput& output);
/// Binary; each face has the property `seed` (int) and a colour. \throw Error write_failed
void write_ply(const std::string& path, const DiagramOutput& output);
/// Each face has its cell's colour; its seed follows as a comment on the line. \throw Error write_failed
void write_off(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
