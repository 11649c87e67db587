/// \file
/// Readers of mesh files, one for each format. A reader takes the bytes of a file and its name for messages,
/// keeps the order of the file, counts from 0 and throws Error invalid_file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <powercell/domain.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

/// Vertices, faces of any number of corners, tetrahedra.
struct MeshFile {
  std::vector<double> vertices;             ///< nv x 3, row-major
  std::vector<std::size_t> face_offset{0};  ///< faces + 1, into face_vertex
  std::vector<std::uint32_t> face_vertex;   ///< corners of the faces, indices from 0
  std::vector<std::uint32_t> tetrahedra;    ///< nt x 4, indices from 0
  /// The first solid that is not a tetrahedron, e.g. "a hexahedron in line 12"; empty if none.
  std::string other_solid;
  bool other_is_quadratic = false;  ///< it is a tetrahedron of 10 nodes, the corners first

  std::size_t vertex_count() const { return vertices.size() / 3; }
  std::size_t face_count() const { return face_offset.size() - 1; }
  void end_face() { face_offset.push_back(face_vertex.size()); }
};

MeshFile parse_off(std::string_view text, const std::string& name);
MeshFile parse_obj(std::string_view text, const std::string& name);
MeshFile parse_ply(std::string_view bytes, const std::string& name);  ///< ASCII and binary
MeshFile parse_stl(std::string_view bytes, const std::string& name);  ///< equal corners become one vertex
MeshFile parse_medit(std::string_view text, const std::string& name);
MeshFile parse_gmsh(std::string_view bytes, const std::string& name);  ///< 2.2 and 4.1, ASCII and binary
MeshFile parse_vtk(std::string_view bytes, const std::string& name);   ///< legacy, ASCII and binary
MeshFile parse_vtu(std::string_view bytes, const std::string& name);
MeshFile parse_tet(std::string_view text, const std::string& name);

/// The number of vertices; refuses more than 32-bit indices can address.
std::size_t checked_vertex_count(std::uint64_t count, const std::string& name);

/// The faces as triangles, nt x 3, with corners in the order of the face and faces in the order of the file.
/// Refuses faces with fewer than 3 corners, by number.
std::vector<std::uint32_t> triangulate(const MeshFile& mesh, const std::string& name);

/// Appends the triangles of one face, three corners each: a convex one as a fan from its first corner.
/// \param vertices  rows of 3
/// \return false for a concave one of more than 4,096 corners, of which none are appended
bool append_triangles(const std::vector<double>& vertices, std::span<const std::uint32_t> corners,
                      std::vector<std::uint32_t>& triangles);

/// The vertices and elements of a mesh domain.
struct MeshArrays {
  DomainKind kind = DomainKind::surface;  ///< surface or volume
  std::vector<double> vertices;           ///< nv x 3
  std::vector<std::uint32_t> elements;    ///< nt x 3 triangles or nt x 4 tetrahedra
};

/// The elements of `kind`; by default the tetrahedra if there are any, else the faces.
MeshArrays choose_elements(MeshFile mesh, std::optional<DomainKind> kind, const std::string& name);

}  // namespace powercell::io
