// STL, ASCII and binary. The format has corners but no vertices: corners at exactly the same position become
// one vertex, in the order of first use, so that neighbouring triangles share vertices again.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <unordered_map>

#include "apps/io/read/bytes.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/mesh.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

constexpr std::size_t binary_header = 84;    // 80 arbitrary bytes, then the number of triangles
constexpr std::size_t binary_triangle = 50;  // normal, three corners, two bytes of attribute

struct PointHash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::uint64_t hash = 0;
    for (double c : p)
      hash = (hash ^ std::bit_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
    return static_cast<std::size_t>(hash);
  }
};

class Welder {
 public:
  explicit Welder(MeshFile& mesh) : mesh_(mesh) {}
  void corner(std::array<double, 3> p) {
    for (double& c : p) c += 0.0;  // makes -0 equal to 0
    const auto [at, fresh] = known_.try_emplace(p, static_cast<std::uint32_t>(mesh_.vertex_count()));
    if (fresh) mesh_.vertices.insert(mesh_.vertices.end(), p.begin(), p.end());
    mesh_.face_vertex.push_back(at->second);
  }

 private:
  MeshFile& mesh_;
  std::unordered_map<std::array<double, 3>, std::uint32_t, PointHash> known_;
};

bool begins_as_ascii(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  return lower_case(trimmed(bytes.substr(0, 256)).substr(0, 5)) == "solid";
}

bool is_binary(std::string_view bytes) {
  if (bytes.size() < binary_header) return false;
  const auto count = load_number<std::uint32_t>(bytes.data() + 80, swapped_from(std::endian::little));
  if (bytes.size() == binary_header + binary_triangle * std::size_t{count}) return true;
  // Some binary files begin with "solid" too, and some have extra bytes at the end; ASCII files contain no
  // NUL.
  return !begins_as_ascii(bytes) || bytes.substr(0, 4096).find('\0') != std::string_view::npos;
}

void parse_binary(std::string_view bytes, const std::string& name, MeshFile& mesh) {
  ByteScanner scanner(bytes, name, std::endian::little, 80);
  const auto count = scanner.next<std::uint32_t>("the number of triangles");
  scanner.need(count, binary_triangle, "triangles");
  Welder welder(mesh);
  for (std::size_t t = 0; t < count; ++t) {
    scanner.skip(3, 4, "a normal");
    for (int k = 0; k < 3; ++k) {
      std::array<double, 3> p;
      for (double& c : p) {
        c = scanner.next<float>("a corner");
        if (!std::isfinite(c))
          scanner.fail(fmt::format("triangle {} (from 0) has a corner that is not finite", t));
      }
      welder.corner(p);
    }
    scanner.skip(2, 1, "an attribute");
    mesh.end_face();
  }
}

void expect(TextScanner& scanner, std::string_view word, std::size_t triangle) {
  if (lower_case(scanner.word({"triangle", triangle})) != word) {
    scanner.fail(fmt::format("triangle {} (from 0): '{}' expected", triangle, word));
  }
}

void parse_ascii(std::string_view text, const std::string& name, MeshFile& mesh) {
  TextScanner scanner(text, name, '\0');
  Welder welder(mesh);
  bool open = false;
  while (!scanner.at_end()) {
    const std::size_t t = mesh.face_count();
    const std::string word = lower_case(scanner.word({"triangle", t}));
    if (word == "solid" || word == "endsolid") {
      open = word == "solid";
      scanner.rest_of_line();
      continue;
    }
    if (word != "facet") scanner.fail(fmt::format("'facet' or 'endsolid' expected after {} triangles", t));
    expect(scanner, "normal", t);
    scanner.rest_of_line();  // some writers give nan for the normal of a flat triangle
    expect(scanner, "outer", t);
    expect(scanner, "loop", t);
    for (int k = 0; k < 3; ++k) {
      expect(scanner, "vertex", t);
      std::array<double, 3> p;
      for (double& c : p) c = scanner.number({"triangle", t});
      welder.corner(p);
    }
    expect(scanner, "endloop", t);
    expect(scanner, "endfacet", t);
    mesh.end_face();
  }
  if (open)
    scanner.fail(fmt::format("the file ends without 'endsolid' after {} triangles; it is truncated",
                             mesh.face_count()));
}

}  // namespace

MeshFile parse_stl(std::string_view bytes, const std::string& name) {
  MeshFile mesh;
  if (is_binary(bytes)) {
    parse_binary(bytes, name, mesh);
  } else {
    if (!begins_as_ascii(bytes)) fail_line(name, 1, "is neither ASCII STL ('solid ...') nor binary STL");
    parse_ascii(bytes, name, mesh);
  }
  return mesh;
}

}  // namespace powercell::io
