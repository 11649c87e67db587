// Gmsh .msh, versions 2.x and 4.1, ASCII and binary: sections between $Name and $EndName. Of these,
// MeshFormat, Nodes and Elements are read, the others (names, entities, data) skipped.
#include "apps/io/read/gmsh.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/io/read/file.hpp"

namespace powercell::io {

const GmshElement& known_gmsh_element(std::int64_t type, GmshNumbers& numbers) {
  // In the order of Gmsh's reference manual, "MSH file format", from 1 to 19.
  static const GmshElement kinds[] = {{2, 1, true, "line"},
                                      {3, 2, true, "triangle"},
                                      {4, 2, true, "quadrangle"},
                                      {4, 3, true, "tetrahedron"},
                                      {8, 3, true, "hexahedron"},
                                      {6, 3, true, "prism"},
                                      {5, 3, true, "pyramid"},
                                      {3, 1, false, "3-node line"},
                                      {6, 2, false, "6-node triangle"},
                                      {9, 2, false, "9-node quadrangle"},
                                      {10, 3, false, "10-node tetrahedron"},
                                      {27, 3, false, "27-node hexahedron"},
                                      {18, 3, false, "18-node prism"},
                                      {14, 3, false, "14-node pyramid"},
                                      {1, 0, true, "point"},
                                      {8, 2, false, "8-node quadrangle"},
                                      {20, 3, false, "20-node hexahedron"},
                                      {15, 3, false, "15-node prism"},
                                      {13, 3, false, "13-node pyramid"}};
  if (type < 1 || type > 19)
    numbers.fail(fmt::format("element type {} is not known; save a mesh of first order", type));
  return kinds[type - 1];
}

void GmshNumbers::enter() {
  if (ascii_) return;
  text_.rest_of_line();
  bytes_.seek(text_.offset());
}

void GmshNumbers::leave() {
  if (!ascii_) text_.seek(bytes_.offset());
}

double GmshNumbers::real(Item item) {
  if (ascii_) return text_.number(item);
  const double value = bytes_.next<double>(item.thing);
  if (!std::isfinite(value)) bytes_.fail(fmt::format("{} {} is not finite", item.thing, item.index));
  return value;
}

std::int64_t GmshNumbers::integer(Item item) {
  if (!ascii_) return bytes_.next<std::int32_t>(item.thing);
  const double value = text_.number(item);  // entity tags may be negative
  if (value != std::floor(value) || std::abs(value) > 1e15) {
    text_.fail(fmt::format("{} {}: {} is not a whole number", item.thing, item.index, value));
  }
  return static_cast<std::int64_t>(value);
}

std::uint64_t GmshNumbers::size(Item item) {
  return ascii_ ? text_.count(item) : bytes_.next<std::uint64_t>(item.thing);
}

void GmshNumbers::check(std::uint64_t count, std::size_t words, std::size_t bytes, const char* things) {
  if (ascii_)
    text_.check_count(count, 2 * words, things);
  else
    bytes_.need(count, bytes, things);
}

void GmshNumbers::fail(const std::string& what) const {
  if (ascii_) text_.fail(what);
  bytes_.fail(what);
}

std::uint32_t GmshNodes::at(std::uint64_t tag, GmshNumbers& numbers, std::uint64_t element) const {
  const auto found = place_of_.find(tag);
  if (found == place_of_.end()) {
    numbers.fail(fmt::format("element {} names node {}, which does not exist", element, tag));
  }
  return found->second;
}

void add_gmsh_element(const GmshElement& kind, const std::uint32_t* nodes, std::uint64_t tag,
                      MeshFile& mesh) {
  if (kind.dimension == 2 && kind.linear) {
    mesh.face_vertex.insert(mesh.face_vertex.end(), nodes, nodes + kind.nodes);
    mesh.end_face();
  } else if (kind.dimension == 3) {
    if (kind.linear && kind.nodes == 4) {
      mesh.tetrahedra.insert(mesh.tetrahedra.end(), nodes, nodes + 4);
    } else if (mesh.other_solid.empty()) {
      mesh.other_solid = fmt::format("a {} (element {})", kind.name, tag);
      mesh.other_is_quadratic = kind.nodes == 10;
    }
  }
}

namespace {

struct GmshFormat {
  double version = 0;
  bool ascii = true;
  std::endian order = std::endian::native;
};

GmshFormat read_format(TextScanner& scanner) {
  GmshFormat format;
  format.version = scanner.number({"version", 0});
  format.ascii = scanner.count({"file type", 0}) == 0;
  const auto data_size = scanner.count({"data size", 0});
  scanner.rest_of_line();
  if (!(format.version >= 2 && format.version < 3) && !(format.version >= 4.1 && format.version < 4.2)) {
    scanner.fail(fmt::format("version {} is not read; save as version 2.2 or 4.1", format.version));
  }
  if (data_size != 8) scanner.fail(fmt::format("data size {} is not read, only 8", data_size));
  if (!format.ascii) {
    ByteScanner bytes(scanner.text(), scanner.name(), std::endian::little, scanner.offset());
    const auto one = bytes.next<std::int32_t>("the byte order");
    if (one != 1 && one != 0x01000000) bytes.fail("the number that shows the byte order is not 1");
    format.order = one == 1 ? std::endian::little : std::endian::big;
    scanner.seek(bytes.offset());
  }
  return format;
}

void skip_section(TextScanner& scanner, const std::string& section) {
  const std::string end = "$End" + section.substr(1);
  const std::size_t at = scanner.text().find("\n" + end, scanner.offset() == 0 ? 0 : scanner.offset() - 1);
  if (at == std::string_view::npos)
    scanner.fail(fmt::format("section {} has no {}; the file is truncated", section, end));
  scanner.seek(at + 1);
}

void expect_end(TextScanner& scanner, const std::string& section) {
  const std::string end = "$End" + section.substr(1);
  if (scanner.word({"end of section", 0}) != end)
    scanner.fail(fmt::format("{} expected; the counts of the section are wrong", end));
}

}  // namespace

MeshFile parse_gmsh(std::string_view bytes, const std::string& name) {
  TextScanner scanner(bytes, name, '\0');
  if (scanner.word({"section", 0}) != "$MeshFormat") scanner.fail("does not begin with $MeshFormat");
  const GmshFormat format = read_format(scanner);
  expect_end(scanner, "$MeshFormat");
  const bool old = format.version < 3;
  GmshNumbers numbers(scanner, format.ascii, format.order);
  GmshNodes nodes;
  MeshFile mesh;
  while (!scanner.at_end()) {
    const std::string section(scanner.word({"section", 0}));
    if (section.size() < 2 || section[0] != '$') scanner.fail("the name of a section ($...) expected");
    if (section == "$Nodes" || section == "$Elements") {
      // Version 2 writes the count of a section as text even in binary files, version 4 does not.
      if (!old) numbers.enter();
      if (section == "$Nodes") {
        if (!mesh.vertices.empty()) scanner.fail("a second section $Nodes; merge the meshes first");
        old ? read_gmsh2_nodes(numbers, nodes, mesh) : read_gmsh4_nodes(numbers, nodes, mesh);
      } else {
        old ? read_gmsh2_elements(numbers, nodes, mesh) : read_gmsh4_elements(numbers, nodes, mesh);
      }
      numbers.leave();
    } else {
      skip_section(scanner, section);
    }
    expect_end(scanner, section);
  }
  if (mesh.vertices.empty()) fail_file(name, "has no section $Nodes");
  return mesh;
}

}  // namespace powercell::io
