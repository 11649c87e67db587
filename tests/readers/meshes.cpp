// Meshes written by Gmsh, meshio and VTK: every format must give the same cube.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>

#include "apps/io/read/domain.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

namespace {

using Vec = std::array<double, 3>;

Vec at(const DomainArrays& mesh, std::size_t element, std::size_t corner, std::size_t corners) {
  const std::size_t v = mesh.elements[element * corners + corner];
  return {mesh.vertices[3 * v], mesh.vertices[3 * v + 1], mesh.vertices[3 * v + 2]};
}
Vec minus(const Vec& a, const Vec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Volume of the tetrahedra, or inside the triangles.
double volume(const DomainArrays& mesh) {
  const std::size_t corners = mesh.kind == DomainKind::volume ? 4 : 3;
  double sum = 0;
  for (std::size_t e = 0; e < mesh.elements.size() / corners; ++e) {
    const Vec a = at(mesh, e, 0, corners), b = at(mesh, e, 1, corners), c = at(mesh, e, 2, corners);
    if (corners == 3) {
      sum += dot(a, cross(b, c)) / 6;
    } else {
      sum += std::abs(dot(minus(at(mesh, e, 3, 4), a), cross(minus(b, a), minus(c, a)))) / 6;
    }
  }
  return sum;
}

double area_of(const DomainArrays& mesh) {
  double sum = 0;
  for (std::size_t e = 0; e < mesh.elements.size() / 3; ++e) {
    const Vec n =
        cross(minus(at(mesh, e, 1, 3), at(mesh, e, 0, 3)), minus(at(mesh, e, 2, 3), at(mesh, e, 0, 3)));
    sum += std::sqrt(dot(n, n)) / 2;
  }
  return sum;
}

DomainArrays load(const std::string& file, std::optional<DomainKind> kind = std::nullopt) {
  return parse_domain(data_bytes(file), lower_extension(file), kind, file);
}

const char* const volume_files[] = {"cube.mesh",
                                    "cube_22_ascii.msh",
                                    "cube_22_binary.msh",
                                    "cube_41_ascii.msh",
                                    "cube_41_binary.msh",
                                    "cube_meshio_ascii.vtk",
                                    "cube_vtk_42_ascii.vtk",
                                    "cube_vtk_42_binary.vtk",
                                    "cube_vtk_51_ascii.vtk",
                                    "cube_vtk_51_binary.vtk",
                                    "cube_meshio_zlib.vtu",
                                    "cube_meshio_plain.vtu",
                                    "cube_vtk_ascii.vtu",
                                    "cube_vtk_base64.vtu",
                                    "cube_vtk_zlib.vtu",
                                    "cube_vtk_appended_raw.vtu",
                                    "cube_vtk_appended_base64.vtu",
                                    "cube_vtk_appended_raw_zlib.vtu",
                                    "cube_vtk_appended_base64_zlib.vtu"};
const char* const surface_files[] = {"cube.off",        "cube.obj",       "cube_ascii.ply",
                                     "cube_binary.ply", "cube_ascii.stl", "cube_binary.stl"};

}  // namespace

TEST_CASE("every volume format gives the same vertices and tetrahedra") {
  const DomainArrays reference = load("cube_22_ascii.msh");
  REQUIRE(reference.elements.size() > 4 * 20);
  for (const char* file : volume_files) {
    CAPTURE(file);
    const DomainArrays mesh = load(file);
    CHECK(mesh.kind == DomainKind::volume);
    CHECK(volume(mesh) == doctest::Approx(1).epsilon(1e-9));
    REQUIRE(mesh.vertices.size() == reference.vertices.size());
    CHECK(mesh.elements == reference.elements);
    double worst = 0;
    for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
      worst = std::max(worst, std::abs(mesh.vertices[k] - reference.vertices[k]));
    }
    CHECK(worst < 1e-9);  // text files of other programs have fewer digits
  }
}

TEST_CASE("every surface format gives the faces of the cube") {
  for (const char* file : surface_files) {
    CAPTURE(file);
    const DomainArrays mesh = load(file);
    CHECK(mesh.kind == DomainKind::surface);
    CHECK(area_of(mesh) == doctest::Approx(6).epsilon(1e-6));
  }
  const DomainArrays off = load("cube.off");
  for (const char* file : {"cube.obj", "cube_ascii.ply", "cube_binary.ply"}) {
    CAPTURE(file);
    CHECK(load(file).elements == off.elements);
  }
}

TEST_CASE("corners of an STL file at the same position become one vertex") {
  const DomainArrays mesh = load("cube_binary.stl");
  std::set<Vec> places;
  for (std::size_t v = 0; v < mesh.vertices.size() / 3; ++v) {
    places.insert({mesh.vertices[3 * v], mesh.vertices[3 * v + 1], mesh.vertices[3 * v + 2]});
  }
  CHECK(places.size() == mesh.vertices.size() / 3);
  CHECK(load("cube_ascii.stl").elements == mesh.elements);
}

TEST_CASE("ASCII STL may begin with blanks or a byte order mark, binary STL with any bytes") {
  const std::string ascii = data_bytes("cube_ascii.stl");
  const DomainArrays mesh = load("cube_ascii.stl");
  std::string upper = ascii;
  for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  for (const std::string& text : {" " + ascii, "\r\n\n" + ascii, "\xEF\xBB\xBF" + ascii, upper}) {
    CAPTURE(text.substr(0, 20));
    CHECK(parse_domain(text, ".stl", std::nullopt, "t.stl").elements == mesh.elements);
  }
  std::string binary = data_bytes("cube_binary.stl");
  for (const char* head : {"solid ", " SOLID ", "\xEF\xBB\xBFsolid"}) {
    binary.replace(0, 80, (head + std::string(80, ' ')).substr(0, 80));
    for (const char* more : {"", "more"})
      CHECK(parse_domain(binary + more, ".stl", std::nullopt, "t.stl").elements == mesh.elements);
  }
}

TEST_CASE("the faces of a volume file make a surface on request") {
  for (const char* file : {"cube.mesh", "cube_22_binary.msh", "cube_41_binary.msh", "cube_vtk_51_binary.vtk",
                           "cube_vtk_appended_raw_zlib.vtu"}) {
    CAPTURE(file);
    const DomainArrays mesh = load(file, DomainKind::surface);
    CHECK(mesh.kind == DomainKind::surface);
    CHECK(area_of(mesh) == doctest::Approx(6).epsilon(1e-9));
  }
}

TEST_CASE("doubles are read exactly, in the order of the file") {
  const std::string text = "OFF\n3 1 0\n1000000000.1 0 0\n1000000000.3 0 1e-7\n0 1 0\n3 2 0 1\n";
  const DomainArrays mesh = parse_domain(text, ".off", std::nullopt, "t.off");
  CHECK(mesh.vertices[0] == 1000000000.1);
  CHECK(mesh.vertices[3] == 1000000000.3);
  CHECK(mesh.vertices[5] == 1e-7);
  CHECK(mesh.elements == std::vector<std::uint32_t>{2, 0, 1});
}

TEST_CASE("OFF: counts, vertices and colours in any arrangement of lines") {
  const std::string faces = "3 0 2 1\n3 0 1 3 255 0 0\n3 0 3 2\n3 1 2 3\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::vector<double> corner{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const std::string& text :
       {"OFF 4 4 6\n" + points + faces, "OFF\n4 4\n6\n" + points + faces, "OFF\n4\n\n4\n6\n" + points + faces,
        "OFF\n4 4\n" + points + faces, "OFF\n4 4 6\n0 0 0  1 0 0\n0 1 0  0 0 1\n" + faces,
        "OFF\n4 4 6\n0 0 0 1 0 0 0 1 0 0 0 1\n" + faces,
        "OFF\n4 4 6\n0\n0 0\n1 0 0\n0 1 0\n0 0\n1 # end\n" + faces,
        "OFF\n4 4 6\n0 0 0 9 8 7\n1 0 0 9 8 7\n0 1 0 9 8 7\n0 0 1 9 8 7\n" + faces,
        "COFF\n4 4\n0 0 0 9 8 7 1\n1 0 0 9 8 7 1\n0 1 0 9 8 7 1\n0 0 1 9 8 7 1\n" + faces,
        "COFF\n4 4 0\n" + points + faces,
        "NOFF\n4 4 6\n0 0 0\n0 0 1\n1 0 0\n0 0 1\n0 1 0\n0 0 1\n0 0 1\n0 0 1\n" + faces}) {
    CAPTURE(text);
    const DomainArrays mesh = parse_domain(text, ".off", std::nullopt, "t.off");
    CHECK(mesh.vertices == corner);
    CHECK(mesh.elements == std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  }
}

TEST_CASE("parts of a file that a mesh does not need are skipped, whatever they contain") {
  const auto elements = [](const std::string& text, const std::string& extension) {
    return parse_domain(text, extension, std::nullopt, "t" + extension).elements;
  };
  const std::vector<std::uint32_t> tetrahedron{0, 1, 2, 3};
  const std::string grid = "\nDATASET UNSTRUCTURED_GRID\n";
  const std::string ascii = "# vtk DataFile Version 4.2\nt\nASCII" + grid;
  const std::string body =
      "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
  CHECK(elements(ascii +
                     "FIELD f 4\ntime 1 1 double\nnan\nMETADATA\nINFORMATION 1\nNAME a LOCATION b\n\nnames 1 "
                     "3 string\nPOINTS%20a b\n\nx\n\nbits 1 9 bit\n" +
                     "0 1 0 1 0 1 0 1\n0\nids 1 2 vtkIdType\n7 8\n" + body,
                 ".vtk") == tetrahedron);
  const auto big = [](auto... values) {
    std::string bytes;
    for (const std::uint32_t value : {static_cast<std::uint32_t>(values)...})
      for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift);
    return bytes;
  };
  const std::uint32_t one = 0x3f800000;  // as a float
  const std::string strings =
      "\xC3x\ny" + std::string("\x80\x02zz", 4) + big(0x40000001) + "a" + big(0, 2) + "bc";
  CHECK(elements("# vtk DataFile Version 4.2\nt\nBINARY" + grid + "FIELD f 3\nnames 1 4 string\n" + strings +
                     "\nbits 1 9 bit\nU@\nids 1 1 int\n" + big(7) + "\nPOINTS 4 float\n" +
                     big(0, 0, 0, one, 0, 0, 0, one, 0, 0, 0, one) + "\nCELLS 1 5\n" + big(4, 0, 1, 2, 3) +
                     "\nCELL_TYPES 1\n" + big(10) + "\n",
                 ".vtk") == tetrahedron);

  const std::string points =
      "<Piece NumberOfPoints='4' NumberOfCells='1'><Points><DataArray>0 0 0 1 0 0 0 1 0 0 0 1"
      "</DataArray></Points><Cells><DataArray Name='connectivity'>0 1 2 3</DataArray><DataArray "
      "Name='offsets'>4</DataArray><DataArray Name='types'>10</DataArray></Cells></Piece>";
  CHECK(elements(
            "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='0' NumberOfCells='0'>"
            "<Points></Points></Piece>" +
                points + "</UnstructuredGrid></VTKFile>",
            ".vtu") == tetrahedron);

  CHECK(elements(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property float nx\nproperty list uchar float w\nelement face 1\nproperty list uchar int "
            "vertex_indices\nend_header\n0 0 0 nan 2 inf 1\n1 0 0 -nan 0\n0 1 0 1 1 1\n3 0 1 2\n",
            ".ply") == std::vector<std::uint32_t>{0, 1, 2});
}

TEST_CASE("CRLF, comments, a byte order mark, colours and negative indices are read") {
  const DomainArrays off = parse_domain(
      "\xEF\xBB\xBFOFF # a comment\r\n\r\n4 1 0\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3 255 0 0\r\n",
      ".off", std::nullopt, "t.off");
  CHECK(off.elements == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  const DomainArrays obj =
      parse_domain("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf -3//1 -2//1 \\\n -1//1\nf 1/1 3/2/1 2\n", ".obj",
                   std::nullopt, "t.obj");
  CHECK(obj.elements == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 1});
}

TEST_CASE("a concave face keeps its area, in any plane") {
  // An arrow head: the fan of its first corner would not stay in the face.
  const std::string rows[] = {"0 0 0\n4 0 0\n2 1 0\n2 4 0\n", "0 0 0\n0 4 0\n0 2 1\n0 2 4\n",
                              "0 0 0\n0 0 4\n1 0 2\n4 0 2\n"};
  for (const std::string& points : rows) {
    for (const char* face : {"4 0 1 2 3", "4 3 2 1 0", "4 1 2 3 0", "4 2 3 0 1"}) {
      const DomainArrays mesh =
          parse_domain("OFF\n4 1 0\n" + points + face + "\n", ".off", std::nullopt, "t.off");
      CHECK(mesh.elements.size() == 6);
      CHECK(area_of(mesh) == doctest::Approx(5));
    }
  }
}

TEST_CASE("quadrilaterals of a Medit file make a surface") {
  const std::string text =
      "MeshVersionFormatted 2\nDimension\n3\nVertices\n4\n0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n"
      "Quadrilaterals 1\n1 2 3 4 7\nCorners 1\n1\nEnd\n";
  CHECK(area_of(parse_domain(text, ".mesh", std::nullopt, "t.mesh")) == doctest::Approx(1));
}

TEST_CASE("plain text is a polygon, a surface or a volume") {
  const DomainArrays plane =
      parse_domain("4 2\n0 0\n2 0\n2 1\n0 1\n3 0 1 2\n3 0 2 3\n", ".txt", std::nullopt, "t.txt");
  CHECK(plane.kind == DomainKind::polygon);
  CHECK(plane.parts.size() == 1);
  CHECK(area(plane.parts) == doctest::Approx(2));
  const DomainArrays bare = parse_domain("4 1\n0 0\n2 0\n2 1\n0 1\n0 1 2 3\n", ".txt", std::nullopt, "t.txt");
  CHECK(area(bare.parts) == doctest::Approx(2));

  const std::string points = "4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  CHECK(volume(parse_domain(points + "0 1 2 3\n", ".txt", std::nullopt, "t.txt")) ==
        doctest::Approx(1.0 / 6));
  CHECK(volume(parse_domain(points + "4 0 1 2 3\n", ".txt", std::nullopt, "t.txt")) ==
        doctest::Approx(1.0 / 6));
  CHECK(parse_domain(points + "3 0 1 2\n", ".txt", DomainKind::surface, "t.txt").elements.size() == 3);
  CHECK(parse_domain(points + "3 0 1 2\n", ".txt", DomainKind::volume, "t.txt").kind == DomainKind::volume);
  CHECK(parse_domain(points + "0 1 2\n", ".txt", std::nullopt, "t.txt").elements.size() == 3);
  CHECK(volume(parse_domain("4 vertices\n1 tets\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n4 0 1 2 3\n", ".tet",
                            std::nullopt, "t.tet")) == doctest::Approx(1.0 / 6));
}
