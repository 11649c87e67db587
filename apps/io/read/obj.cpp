// Wavefront OBJ: `v x y z` and `f a/t/n b c ...`. Indices start at 1; negative ones count from the end.
// Everything else (normals, textures, groups, materials, lines, points) is skipped.
#include <fmt/format.h>

#include <charconv>

#include "apps/io/read/file.hpp"
#include "apps/io/read/mesh.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

void read_vertex(TextScanner& scanner, std::string_view row, MeshFile& mesh) {
  std::string_view word;
  for (int axis = 0; axis < 3; ++axis) {
    if (!next_word(row, word))
      scanner.fail(fmt::format("vertex {} has {} of 3 coordinates", mesh.vertex_count() + 1, axis));
    double value = 0;
    const Parsed parsed = parse_number(word, value);
    if (parsed != Parsed::ok) {
      scanner.fail(
          fmt::format("vertex {}: {}", (mesh.vertices.size() - axis) / 3 + 1, why_not(word, parsed)));
    }
    mesh.vertices.push_back(value);
  }
}

void read_face(TextScanner& scanner, std::string_view row, MeshFile& mesh) {
  std::string_view word;
  while (next_word(row, word)) {
    const std::string_view corner = word.substr(0, word.find('/'));
    std::int64_t index = 0;
    const auto [end, code] = std::from_chars(corner.data(), corner.data() + corner.size(), index);
    if (code != std::errc() || end != corner.data() + corner.size()) {
      scanner.fail(fmt::format("face {}: '{}' is not an index", mesh.face_count() + 1,
                               std::string(corner.substr(0, 40))));
    }
    // A face may name a vertex that follows later in the file, so the upper limit is checked at the end.
    if (index < 0) index += static_cast<std::int64_t>(mesh.vertex_count()) + 1;
    if (index < 1 || index > std::int64_t{0xffffffff}) {
      scanner.fail(fmt::format("face {}: index {} is out of range; vertices are numbered from 1",
                               mesh.face_count() + 1, std::string(corner)));
    }
    mesh.face_vertex.push_back(static_cast<std::uint32_t>(index - 1));
  }
  mesh.end_face();
  const auto corners = mesh.face_offset.back() - mesh.face_offset[mesh.face_count() - 1];
  if (corners < 3)
    scanner.fail(fmt::format("face {} has {} corners; it needs 3", mesh.face_count(), corners));
}

}  // namespace

MeshFile parse_obj(std::string_view text, const std::string& name) {
  TextScanner scanner(text, name);
  MeshFile mesh;
  std::vector<std::size_t> line_of_face;
  std::string joined;
  while (auto line = scanner.line()) {
    std::string_view row = *line;
    if (row.ends_with('\\')) {  // the row continues in the next line
      joined.assign(row.substr(0, row.size() - 1));
      while (row.ends_with('\\') && !scanner.at_end()) {
        row = scanner.rest_of_line();
        joined.append(" ").append(row.ends_with('\\') ? row.substr(0, row.size() - 1) : row);
      }
      row = joined;
    }
    std::string_view keyword;
    next_word(row, keyword);
    if (keyword == "v") read_vertex(scanner, row, mesh);
    if (keyword == "f") {
      read_face(scanner, row, mesh);
      line_of_face.push_back(scanner.line_number());
    }
  }
  checked_vertex_count(mesh.vertex_count(), name);
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    for (std::size_t k = mesh.face_offset[face]; k < mesh.face_offset[face + 1]; ++k) {
      if (mesh.face_vertex[k] < mesh.vertex_count()) continue;
      fail_line(name, line_of_face[face],
                fmt::format("face {}: index {} is out of range; the file has {} vertices, numbered from 1",
                            face + 1, std::size_t{mesh.face_vertex[k]} + 1, mesh.vertex_count()));
    }
  }
  if (mesh.vertices.empty()) fail_file(name, "has no vertices (rows `v x y z`)");
  return mesh;
}

}  // namespace powercell::io
