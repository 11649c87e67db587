// Medit .mesh, ASCII: sections of a keyword, a count and rows. Indices start at 1; each row ends with a
// reference.
#include <fmt/format.h>

#include <cctype>

#include "apps/io/read/file.hpp"
#include "apps/io/read/mesh.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

bool is_keyword(std::string_view word) {
  return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0]));
}

void read_vertices(TextScanner& scanner, const std::string& name, MeshFile& mesh) {
  const auto count = scanner.count({"number of vertices", 0});
  scanner.check_count(count, 8, "vertices");
  if (!mesh.vertices.empty()) scanner.fail("a second section Vertices");
  mesh.vertices.reserve(3 * checked_vertex_count(count, name));
  for (std::size_t v = 0; v < count; ++v) {
    for (int axis = 0; axis < 3; ++axis) mesh.vertices.push_back(scanner.number({"vertex", v + 1}));
    scanner.number({"the reference of vertex", v + 1});
  }
}

template <class Corner>
void read_elements(TextScanner& scanner, const char* thing, int corners, std::size_t vertices,
                   Corner corner) {
  const auto count = scanner.count({"number of elements", 0});
  scanner.check_count(count, 2 * (corners + 1), "elements");
  for (std::size_t e = 0; e < count; ++e) {
    for (int k = 0; k < corners; ++k) corner(scanner.index({thing, e + 1}, vertices, 1), k);
    scanner.number({thing, e + 1});
  }
}

void read_faces(TextScanner& scanner, const char* thing, int corners, MeshFile& mesh) {
  read_elements(scanner, thing, corners, mesh.vertex_count(), [&](std::uint32_t vertex, int k) {
    mesh.face_vertex.push_back(vertex);
    if (k == corners - 1) mesh.end_face();
  });
}

void read_section(TextScanner& scanner, std::string_view keyword, const std::string& name, MeshFile& mesh) {
  if (keyword == "MeshVersionFormatted") {
    scanner.count({"version", 0});
  } else if (keyword == "Dimension") {
    if (scanner.count({"dimension", 0}) != 3)
      scanner.fail("the dimension is not 3; a plane mesh is not a volume");
  } else if (keyword == "Vertices") {
    read_vertices(scanner, name, mesh);
  } else if (keyword == "Triangles") {
    read_faces(scanner, "triangle", 3, mesh);
  } else if (keyword == "Quadrilaterals") {
    read_faces(scanner, "quadrilateral", 4, mesh);
  } else if (keyword == "Tetrahedra") {
    read_elements(scanner, "tetrahedron", 4, mesh.vertex_count(),
                  [&](std::uint32_t vertex, int) { mesh.tetrahedra.push_back(vertex); });
  } else {
    const bool solid = keyword == "Hexahedra" || keyword == "Hexaedra" || keyword == "Prisms" ||
                       keyword == "Wedges" || keyword == "Pyramids" || keyword == "TetrahedraP2";
    if (solid && mesh.other_solid.empty() && scanner.peek() != "0") {
      mesh.other_solid = fmt::format("{} in line {}", keyword, scanner.line_number());
    }
    while (!scanner.at_end() && !is_keyword(scanner.peek())) scanner.word({"section", 0});
  }
}

}  // namespace

MeshFile parse_medit(std::string_view text, const std::string& name) {
  TextScanner scanner(text, name);
  MeshFile mesh;
  bool first = true, ended = false;
  while (!scanner.at_end() && !ended) {
    const std::string_view keyword = scanner.word({"section", 0});
    if (first && keyword != "MeshVersionFormatted" && keyword != "MeshVersionUnformatted") {
      scanner.fail(
          "does not begin with MeshVersionFormatted; is it an ASCII Medit file (.mesh, not .meshb)?");
    }
    if (!is_keyword(keyword))
      scanner.fail(fmt::format("'{}' instead of a keyword; the count above is wrong", keyword.substr(0, 40)));
    first = false;
    ended = keyword == "End";
    if (!ended) read_section(scanner, keyword, name, mesh);
  }
  // Some writers omit "End", so its absence does not show truncation.
  if (mesh.vertices.empty()) fail_file(name, "has no section Vertices before its end");
  return mesh;
}

}  // namespace powercell::io
