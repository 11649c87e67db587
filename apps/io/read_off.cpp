// OFF: a header word, counts `nv nf ne`, vertex rows, face rows `k i0 ... [colour]`. ASCII.
#include <fmt/format.h>

#include "apps/io/read_file.hpp"
#include "apps/io/read_mesh.hpp"
#include "apps/io/read_text.hpp"

namespace powercell::io {
namespace {

// OFF with any of the prefixes ST (texture), C (colour), N (normal): numbers after the position.
void read_header(TextScanner& scanner) {
  std::string_view header = scanner.word({"header", 0});
  if (header.starts_with("ST")) header.remove_prefix(2);
  if (header.starts_with("C")) header.remove_prefix(1);
  if (header.starts_with("N")) header.remove_prefix(1);
  if (header != "OFF") {
    scanner.fail("does not begin with OFF (or COFF, NOFF, STOFF); 4OFF and nOFF are not surfaces in space");
  }
  if (scanner.peek() == "BINARY") scanner.fail("binary OFF is not read; save it as ASCII OFF or PLY");
}

}  // namespace

MeshFile parse_off(std::string_view text, const std::string& name) {
  TextScanner scanner(text, name);
  read_header(scanner);
  const auto vertices = scanner.count({"count", 0});
  const auto faces = scanner.count({"count", 1});
  scanner.rest_of_line();  // the number of edges, which many writers leave out or set to 0
  scanner.check_count(vertices, 6, "vertices");
  scanner.check_count(faces, 4, "faces");

  MeshFile mesh;
  mesh.vertices.reserve(3 * checked_vertex_count(vertices, name));
  for (std::size_t v = 0; v < vertices; ++v) {
    for (int axis = 0; axis < 3; ++axis) mesh.vertices.push_back(scanner.number({"vertex", v}));
    scanner.rest_of_line();
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const auto corners = scanner.count({"face", f});
    scanner.check_count(corners, 2, "corners");
    for (std::size_t k = 0; k < corners; ++k) {
      mesh.face_vertex.push_back(scanner.index({"face", f}, vertices));
    }
    scanner.rest_of_line();
    mesh.end_face();
  }
  if (!scanner.at_end()) {
    scanner.word({"end", 0});
    scanner.fail(fmt::format("more text after the {} faces announced", faces));
  }
  return mesh;
}

}  // namespace powercell::io
