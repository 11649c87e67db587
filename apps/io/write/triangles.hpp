/// \file
/// Triangle meshes as files.
#pragma once

#include <powercell/shapes.hpp>
#include <string>
#include <string_view>

namespace powercell::io {

inline constexpr std::string_view triangle_files = ".off .obj .ply .stl";

/// \throw Error invalid_file for an extension that is neither one of those nor .png
void check_triangle_output(const std::string& path);

/// Writes a mesh by the extension of `path`: OFF and OBJ as text in full precision, PLY and STL binary (STL
/// in single precision).
/// \throw Error invalid_file (extension), write_failed
void write_triangles(const std::string& path, const TriangleMesh& mesh);

}  // namespace powercell::io
