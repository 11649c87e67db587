/// \file
/// Files of other programs that are not read, with what converts them.
#pragma once

#include <string>
#include <string_view>

namespace powercell::io {

/// Refuses maps such as KML, GML and shapefiles, by their extension in lower case.
/// \throw Error invalid_file
void refuse_foreign_map(const std::string& extension, const std::string& name);

/// The same of meshes of TetGen.
void refuse_foreign_mesh(const std::string& extension, const std::string& name);

/// Refuses the atoms of LAMMPS, VASP and XYZ files, nodes of TetGen, meshes, and documents of XML, by how a
/// text begins. \throw Error invalid_file
void refuse_foreign_seeds(std::string_view text, const std::string& name);

}  // namespace powercell::io
