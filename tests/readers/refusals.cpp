// Malformed meshes are refused with the place of the fault, and never allocate memory for a wrong count.
#include <doctest/doctest.h>

#include <random>

#include "apps/io/read/domain.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

namespace {

std::string refused(const std::string& text, const std::string& extension,
                    std::optional<DomainKind> kind = std::nullopt) {
  return refusal([&] { parse_domain(text, extension, kind, "f" + extension); });
}

const char* const meshes[] = {"cube.mesh",
                              "cube_22_ascii.msh",
                              "cube_22_binary.msh",
                              "cube_41_ascii.msh",
                              "cube_41_binary.msh",
                              "cube_vtk_42_ascii.vtk",
                              "cube_vtk_42_binary.vtk",
                              "cube_vtk_51_ascii.vtk",
                              "cube_vtk_51_binary.vtk",
                              "cube_vtk_ascii.vtu",
                              "cube_vtk_base64.vtu",
                              "cube_vtk_zlib.vtu",
                              "cube_vtk_appended_raw.vtu",
                              "cube_vtk_appended_base64_zlib.vtu",
                              "cube_vtk_appended_raw_zlib.vtu",
                              "cube.off",
                              "cube.obj",
                              "cube_ascii.ply",
                              "cube_binary.ply",
                              "cube_ascii.stl",
                              "cube_binary.stl"};

}  // namespace

TEST_CASE("OFF") {
  CHECK(says(refused("OOF\n", ".off"), "invalid_file: f.off:1: does not begin with OFF"));
  CHECK(says(refused("OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n", ".off"),
             "f.off:4: vertex 1: 'zero' is not a number"));
  CHECK(says(refused("OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", ".off"),
             "f.off:4: vertex 1: 'nan' is not a finite number"));
  CHECK(says(refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ".off"),
             "f.off:6: face 0: index 3 is out of range"));
  CHECK(says(refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", ".off"),
             "face 0: index -1 is out of range"));
  CHECK(says(refused("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ".off"), "f.off:"));
  CHECK(says(refused("OFF\n4000000000 1 0\n0 0 0\n", ".off"),
             "4000000000 vertices are announced, but only 6 bytes are left"));
  CHECK(says(refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", ".off"), "face 0 (from 0) has 2 corners"));
  CHECK(
      says(refused("OFF\n3 1 0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ".off"), "f.off:2: more than three counts"));
  CHECK(says(refused("OFF\n3 1\n0 0 0 1 0 0\n0 1 0\n3 0 1 2\n", ".off"),
             "f.off:2: the number of edges is missing"));
  CHECK(says(refused("OFF\n3 1 0\n0 0 0 1 0 0\n0 1 0 7\n3 0 1 2\n", ".off"),
             "f.off:4: the line continues after the last of 3 vertices"));
  CHECK(
      says(refused("COFF\n2 1 0\n0 0 0 9 9 9 1 0 0 9 9 9\n3 0 1 1\n", ".off"),
           "f.off:2: vertices and faces are not on lines of their own, and colours may have 3 or 4 numbers"));
  CHECK(says(refused("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", ".off"), "neither tetrahedra nor faces"));
  std::string quadratic = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n";
  for (int node = 1; node <= 10; ++node)
    quadratic += std::to_string(node) + " 0 0 " + std::to_string(node) + "\n";
  quadratic += "$EndNodes\n$Elements\n1\n1 11 2 0 0 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";
  CHECK(says(refused(quadratic.c_str(), ".msh"), "if edges are straight, its corners are enough"));
}

TEST_CASE("OBJ") {
  CHECK(says(refused("v 0 0 0\nv 1 0\n", ".obj"), "f.obj:2: vertex 2 has 2 of 3 coordinates"));
  CHECK(says(refused("v 0 0 0\nv 1 0 inf\n", ".obj"), "f.obj:2: vertex 2: 'inf' is not a finite number"));
  CHECK(says(refused("v 0 0 0\nf 1 1 2\n", ".obj"),
             "f.obj:2: face 1: index 2 is out of range; the file has 1 vertices"));
  CHECK(says(refused("v 0 0 0\nf 0 1 1\n", ".obj"), "f.obj:2: face 1: index 0 is out of range"));
  CHECK(says(refused("v 0 0 0\nf 1 1\n", ".obj"), "f.obj:2: face 1 has 2 corners"));
  CHECK(says(refused("# nothing\n", ".obj"), "f.obj: has no vertices"));
}

TEST_CASE("PLY and STL") {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK(refused(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ".ply") == "nothing");
  CHECK(says(refused(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 5\n", ".ply"),
             "f.ply:13: face 0: index 5 is out of range"));
  CHECK(says(refused(head + "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n", ".ply"),
             "f.ply:11: vertex 1: 'x' is not a number"));
  CHECK(says(refused(head + "0 0 0\n1 0 0\n", ".ply"), "f.ply:"));
  CHECK(says(
      refused("ply\nformat ascii 1.0\nelement vertex 99999999\nproperty float x\nend_header\n1\n", ".ply"),
      "99999999 vertex are announced"));
  // An element without properties must have the count 0.
  const std::string corners = head.substr(0, head.find("element face"));
  CHECK(says(refused(corners + "element face 0\nend_header\n0 0 0\n1 0 0\n0 1 0\n", ".ply"),
             "neither tetrahedra nor faces"));
  CHECK(says(refused(corners + "element face 1\nend_header\n0 0 0\n1 0 0\n0 1 0\n", ".ply"),
             "element face has no properties"));
  CHECK(says(refused("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 nan\n", ".stl"),
             "f.stl:5: triangle 0: 'nan'"));
  CHECK(says(refused("solid a\nfacet normal 0 0 1\nouter lop\n", ".stl"),
             "f.stl:3: triangle 0 (from 0): 'loop' expected"));
  CHECK(says(refused("nothing at all", ".stl"), "neither ASCII STL"));
}

TEST_CASE("solids that are not tetrahedra") {
  const std::string hexahedron =
      "MeshVersionFormatted 2\nDimension 3\nVertices 8\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 "
      "0\n"
      "1 1 1 0\n0 1 1 0\nHexahedra 1\n1 2 3 4 5 6 7 8 0\nEnd\n";
  CHECK(says(refused(hexahedron, ".mesh"), "Hexahedra in line 12; only tetrahedra make a volume"));
  const std::string wedge =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n"
      "0 0 0 1 0 0 0 1 0 0 0 1 1 0 1 0 1 1\nCELLS 1 7\n6 0 1 2 3 4 5\nCELL_TYPES 1\n13\n";
  CHECK(says(refused(wedge, ".vtk"), "a wedge (cell 0, from 0); only tetrahedra"));
  const std::string pyramid =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n9 0 0 "
      "1\n$EndNodes\n"
      "$Elements\n1\n1 7 2 0 1 1 2 3 4 9\n$EndElements\n";
  CHECK(says(refused(pyramid, ".msh"), "a pyramid (element 1); only tetrahedra"));
}

TEST_CASE("volume formats: indices, NaN, counts") {
  CHECK(says(
      refused("MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0 0 0\nTetrahedra 1\n1 1 1 2 0\n", ".mesh"),
      "f.mesh:6: tetrahedron 1: index 2 is out of range; the file has 1 vertices, numbered from 1"));
  CHECK(says(refused("MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 nan 0 0\n", ".mesh"),
             "f.mesh:4: vertex 1: 'nan'"));
  CHECK(says(refused("MeshVersionFormatted 2\nDimension 3\nVertices 999999999\n0 0 0 0\n", ".mesh"),
             "999999999 vertices are announced"));
  CHECK(says(refused("MeshVersionFormatted 2\nDimension 2\n", ".mesh"), "f.mesh:2: the dimension is not 3"));
  CHECK(says(refused("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 4 "
                     "0 1 1 1 7\n$EndElements\n",
                     ".msh"),
             "f.msh:10: element 1 names node 7, which does not exist"));
  CHECK(says(refused("$MeshFormat\n4.0 0 8\n$EndMeshFormat\n", ".msh"),
             "f.msh:2: version 4 is not read; save as version 2.2 or 4.1"));
  CHECK(says(refused("# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n", ".vtk"),
             "f.vtk:4: data set STRUCTURED_GRID is not read"));
  CHECK(says(refused("4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 2 3 4\n", ".tet"),
             "f.tet:6: element 0 (from 0): index 4 is out of range; the file has "
             "4 points, numbered from 0 (this file seems to count from 1: subtract 1)"));
  CHECK(says(refused("4 1\n0 0 0\n1 0 0\n0 1\n0 0 1\n1 2 3 4\n", ".tet"),
             "f.tet:4: point 2 (from 0) has 2 coordinates"));
  CHECK(says(refused("3 1\n0 0\n1 0\n0 1\n0 1 2\n9 9 9\n", ".txt"), "f.txt:6: more rows"));
  const auto piece = [](const std::string& attributes) {
    return "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece " + attributes +
           "><Points/></Piece></UnstructuredGrid></VTKFile>";
  };
  CHECK(says(refused(piece("NumberOfPoints='0' NumberOfCells='0'"), ".vtu"), "f.vtu: has no points"));
  CHECK(says(refused(piece("NumberOfPoints='0' NumberOfCells='1'"), ".vtu"), "f.vtu:1: a piece lacks"));
  CHECK(says(refused(piece("NumberOfCells='0'"), ".vtu"), "f.vtu:1: a piece lacks"));
  CHECK(
      says(refused("# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nFIELD f 1\na 1 1 string\n\xC9x",
                   ".vtk"),
           "the file ends in a string: 9 of 1 bytes are needed and 1 bytes are left"));
  CHECK(says(
      refused("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nFIELD f 1\na 1 1 variant\n1", ".vtk"),
      "'VARIANT' is not a type"));
  CHECK(says(refused("<VTKFile type='PolyData'/>", ".vtu"), "f.vtu:1: VTKFile of type 'PolyData'"));
  CHECK(says(refused("x", ".foo"), "unknown extension '.foo'; a domain is .geojson"));
  CHECK(says(refused("OFF\n", ".off", DomainKind::polygon), "f.off"));
  CHECK(says(refused("POLYGON ((0 0, 1 0, 0 1, 0 0))", ".wkt", DomainKind::volume),
             "f.wkt: holds a polygon, but a volume is wanted"));
}

TEST_CASE("plain text whose rows begin with their length or with a corner") {
  const std::string square = "4 1\n0 0\n1 0\n1 1\n0 1\n",
                    body = "5 4\n0 0 0\n1 0 0\n0 1 0\n.2 .2 .2\n0 0 1\n",
                    rows = "3 0 1 2\n3 0 1 4\n3 0 2 4\n3 1 2 4\n";
  CHECK(says(
      refused(square + "3 0 1 2\n", ".txt"),
      "f.txt:6: the first number of every row may be the number of corners, which leaves point 3 (from 0) "
      "unused, or a corner itself; write the number"));
  CHECK(refused(square + "4 3 0 1 2\n", ".txt") == "nothing");
  CHECK(refused("3 1\n0 0\n1 0\n1 1\n3 0 1 2\n", ".txt") == "nothing");
  CHECK(refused("5 1\n0 0\n1 0\n1 1\n0 1\n7 7\n3 0 1 2\n", ".txt") == "nothing");  // point 4 is unused anyway
  CHECK(says(refused(body + rows, ".txt"),
             "use --kind surface (numbers) or --kind volume (corners), or write"));
  CHECK(parse_domain(body + rows, ".txt", DomainKind::volume, "f.txt").elements.size() == 16);
  CHECK(parse_domain(body + rows, ".txt", DomainKind::surface, "f.txt").elements.size() == 12);
  CHECK(refused(body + rows, ".tet") == "nothing");
}

TEST_CASE("files that are missing, empty or folders") {
  const TemporaryFolder folder;
  CHECK(says(refusal([&] { read_domain(folder.path("none.off")); }), "none.off: no such file"));
  CHECK(says(refusal([&] { read_domain(folder.path("")); }), "is a directory"));
  CHECK(says(refusal([&] { read_domain(folder.write("empty.off", "")); }), "empty.off: is empty"));
}

TEST_CASE("a file truncated anywhere is refused or complete, without a crash") {
  for (const char* file : meshes) {
    CAPTURE(file);
    const std::string bytes = data_bytes(file);
    const DomainArrays whole = parse_domain(bytes, lower_extension(file), std::nullopt, file);
    std::size_t passed = 0;
    for (std::size_t cut = 0; cut < bytes.size(); cut += 7) {
      try {
        const DomainArrays part =
            parse_domain(bytes.substr(0, cut), lower_extension(file), std::nullopt, file);
        ++passed;
        CHECK(part.vertices.size() <= whole.vertices.size());
      } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_file);
        CHECK(says(error.what(), file));
      }
    }
    if (lower_extension(file) != ".obj") CHECK(passed <= bytes.size() / 7 / 2);  // OBJ announces no counts
  }
}

TEST_CASE("files with randomly changed bytes are refused or read, without a crash") {
  std::mt19937 random(7);
  for (const char* file : meshes) {
    const std::string bytes = data_bytes(file);
    for (int trial = 0; trial < 300; ++trial) {
      std::string changed = bytes;
      for (int k = 0; k < 3; ++k) changed[random() % changed.size()] = static_cast<char>(random());
      try {
        const DomainArrays mesh = parse_domain(changed, lower_extension(file), std::nullopt, file);
        for (std::uint32_t v : mesh.elements) REQUIRE(v < mesh.vertices.size() / 3);
      } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_file);
      }
    }
  }
}
