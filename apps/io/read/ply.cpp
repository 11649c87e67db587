// PLY, ASCII and binary of either byte order: vertex x y z and face vertex_indices (or vertex_index);
// other elements and properties are skipped.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>

#include "apps/io/read/bytes.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/mesh.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

using Type = NumberType;

struct Property {
  std::string name;
  Type type;
  bool list = false;
  Type count_type = Type::u8;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool ascii = true;
  std::endian order = std::endian::little;
  std::vector<Element> elements;
};

Type type_of(TextScanner& scanner, std::string_view word) {
  constexpr std::pair<std::string_view, Type> types[] = {
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  for (const auto& [name, type] : types) {
    if (word == name) return type;
  }
  scanner.fail(fmt::format("'{}' is not a PLY type", std::string(word.substr(0, 40))));
}

void read_format(TextScanner& scanner, Header& header) {
  const std::string_view format = scanner.word({"format", 0});
  header.ascii = format == "ascii";
  header.order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
  if (!header.ascii && format != "binary_big_endian" && format != "binary_little_endian") {
    scanner.fail("the format is not ascii, binary_little_endian or binary_big_endian");
  }
  scanner.rest_of_line();
}

Property read_property(TextScanner& scanner) {
  Property property;
  std::string_view word = scanner.word({"property", 0});
  if (word == "list") {
    property.list = true;
    property.count_type = type_of(scanner, scanner.word({"property", 0}));
    word = scanner.word({"property", 0});
  }
  property.type = type_of(scanner, word);
  property.name = scanner.word({"property", 0});
  scanner.rest_of_line();
  return property;
}

Header read_header(TextScanner& scanner) {
  if (scanner.word({"header", 0}) != "ply") scanner.fail("does not begin with 'ply'");
  Header header;
  for (;;) {
    const std::string_view word = scanner.word({"header", 0});
    if (word == "end_header") break;
    if (word == "format") {
      read_format(scanner, header);
    } else if (word == "element") {
      Element element;
      element.name = scanner.word({"element", header.elements.size()});
      element.count = scanner.count({"element", header.elements.size()});
      header.elements.push_back(element);
    } else if (word == "property") {
      if (header.elements.empty()) scanner.fail("a property comes before any element");
      header.elements.back().properties.push_back(read_property(scanner));
    } else if (word == "comment" || word == "obj_info") {
      scanner.rest_of_line();
    } else {
      scanner.fail(fmt::format("'{}' is not a word of a PLY header", std::string(word.substr(0, 40))));
    }
  }
  scanner.rest_of_line();  // the data begin right after this line end
  return header;
}

// Reads numbers from text or bytes.
class Values {
 public:
  Values(TextScanner& text, const Header& header, const std::string& name)
      : text_(text), ascii_(header.ascii), bytes_(text.text(), name, header.order, text.offset()) {}

  double next(Type type, Item item) { return ascii_ ? text_.number(item) : bytes_.next(type, item.thing); }
  void skip(Type type, Item item) {
    if (ascii_)
      text_.word(item);  // may be nan, as some normals are
    else
      bytes_.skip(1, size_of(type), item.thing);
  }
  void check_count(std::uint64_t count, std::size_t least_text, std::size_t least_bytes,
                   const char* things) const {
    if (ascii_)
      text_.check_count(count, least_text, things);
    else
      bytes_.need(count, least_bytes, things);
  }
  [[noreturn]] void fail(const std::string& what) const {
    if (ascii_) text_.fail(what);
    bytes_.fail(what);
  }

 private:
  TextScanner& text_;
  bool ascii_;
  ByteScanner bytes_;
};

std::size_t list_length(Values& values, const Property& property, Item item) {
  const double count = values.next(property.count_type, item);
  if (!(count >= 0) || count != std::floor(count) || count > 4294967295.0) {
    values.fail(fmt::format("{} {}: {} is not the length of a list", item.thing, item.index, count));
  }
  values.check_count(static_cast<std::uint64_t>(count), 2, size_of(property.type), "list entries");
  return static_cast<std::size_t>(count);
}

void skip(Values& values, const Property& property, Item item) {
  const std::size_t count = property.list ? list_length(values, property, item) : 1;
  for (std::size_t k = 0; k < count; ++k) values.skip(property.type, item);
}

void read_vertices(Values& values, const Element& element, MeshFile& mesh) {
  for (std::size_t v = 0; v < element.count; ++v) {
    std::array<double, 3> p{};
    unsigned found = 0;
    for (const Property& property : element.properties) {
      const bool coordinate =
          !property.list && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
      if (!coordinate) {
        skip(values, property, {"vertex", v});
        continue;
      }
      const int axis = property.name[0] - 'x';
      p[axis] = values.next(property.type, {"vertex", v});
      if (!std::isfinite(p[axis]))
        values.fail(fmt::format("vertex {} has a coordinate that is not finite", v));
      found |= 1u << axis;
    }
    if (found != 7u) values.fail("element vertex lacks one of the properties x, y, z");
    mesh.vertices.insert(mesh.vertices.end(), p.begin(), p.end());
  }
}

void read_faces(Values& values, const Element& element, std::uint64_t vertices, MeshFile& mesh) {
  for (std::size_t f = 0; f < element.count; ++f) {
    bool found = false;
    for (const Property& property : element.properties) {
      if (!property.list || found || (property.name != "vertex_indices" && property.name != "vertex_index")) {
        skip(values, property, {"face", f});
        continue;
      }
      found = true;
      const std::size_t corners = list_length(values, property, {"face", f});
      for (std::size_t k = 0; k < corners; ++k) {
        const double index = values.next(property.type, {"face", f});
        if (!(index >= 0) || index != std::floor(index) || index >= static_cast<double>(vertices)) {
          values.fail(
              fmt::format("face {}: index {} is out of range; the file has {} vertices, numbered from 0", f,
                          index, vertices));
        }
        mesh.face_vertex.push_back(static_cast<std::uint32_t>(index));
      }
    }
    if (!found) values.fail("element face lacks the list property vertex_indices");
    mesh.end_face();
  }
}

// Refuses a count of elements that the file cannot hold, which must neither allocate nor loop.
void check_size(Values& values, const Element& element) {
  if (element.count == 0) return;  // it may have no properties either
  std::size_t least = 0;
  for (const Property& property : element.properties)
    least += size_of(property.list ? property.count_type : property.type);
  if (least == 0) values.fail(fmt::format("element {} has no properties", element.name));
  values.check_count(element.count, 2 * element.properties.size(), least, element.name.c_str());
}

}  // namespace

MeshFile parse_ply(std::string_view bytes, const std::string& name) {
  TextScanner scanner(bytes, name, '\0');
  const Header header = read_header(scanner);
  std::uint64_t vertices = 0;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") vertices = checked_vertex_count(element.count, name);
  }
  Values values(scanner, header, name);
  MeshFile mesh;
  for (const Element& element : header.elements) {
    check_size(values, element);
    if (element.name == "vertex") {
      if (!mesh.vertices.empty()) values.fail("has two elements named vertex");
      read_vertices(values, element, mesh);
    } else if (element.name == "face") {
      read_faces(values, element, vertices, mesh);
    } else {
      for (std::size_t k = 0; k < element.count; ++k) {
        for (const Property& property : element.properties) skip(values, property, {element.name.c_str(), k});
      }
    }
  }
  if (mesh.vertices.empty()) fail_file(name, "has no vertices");
  return mesh;
}

}  // namespace powercell::io
