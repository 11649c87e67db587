// OFF: a header word, counts `nv nf ne`, vertices, face rows `k i0 ... [colour]`. ASCII. The format is free:
// line ends matter behind a face only. Most files keep a line for each vertex all the same, and many of them
// have colours behind the coordinates that no header announces.
#include <fmt/format.h>

#include "apps/io/read/mesh.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

// The numbers of a vertex, from the header.
struct VertexKind {
  std::size_t words = 3;  // at least
  bool coloured = false;  // with 3 or 4 numbers; the header does not show which
};

struct Counts {
  std::uint64_t vertices, faces;
  bool edges;  // whether their number is given, which many writers omit or set to 0
};

// OFF with any of the prefixes ST (texture), C (colour), N (normal): numbers after the position.
VertexKind read_header(TextScanner& scanner) {
  std::string_view header = scanner.word({"header", 0});
  VertexKind kind;
  const auto prefix = [&](std::string_view letters, std::size_t words) {
    if (!header.starts_with(letters)) return false;
    header.remove_prefix(letters.size());
    kind.words += words;
    return true;
  };
  prefix("ST", 2);
  kind.coloured = prefix("C", 3);
  prefix("N", 3);
  if (header != "OFF") {
    scanner.fail("does not begin with OFF (or COFF, NOFF, STOFF); 4OFF and nOFF are not surfaces in space");
  }
  if (scanner.peek() == "BINARY") scanner.fail("binary OFF is not read; save it as ASCII OFF or PLY");
  return kind;
}

std::size_t count_words(std::string_view line) {
  std::size_t words = 0;
  for (std::string_view word; next_word(line, word);) ++words;
  return words;
}

Counts read_counts(TextScanner& scanner) {
  Counts counts{scanner.count({"count", 0}), scanner.count({"count", 1}), false};
  TextScanner ahead = scanner;
  std::size_t words = count_words(ahead.rest_of_line());
  if (words > 1) scanner.fail("more than three counts; start the vertices on a new line");
  if (words == 0) words = count_words(ahead.line().value_or(""));  // a vertex has three words
  counts.edges = words == 1;
  if (counts.edges) scanner.count({"count", 2});
  scanner.rest_of_line();
  return counts;
}

// Whether each vertex has a line of its own: the file has enough lines for all vertices and faces, and the
// lines of the vertices have equally many numbers. If vertices share lines there are fewer lines; if a vertex
// spans several lines they have fewer numbers. A file with exactly one line for each vertex and face is
// complete, whatever its header announces.
bool vertex_a_line(TextScanner scanner, const Counts& counts, const VertexKind& kind) {
  std::size_t lines = 0, words = 0;
  for (; const auto line = scanner.line(); ++lines) {
    if (lines >= counts.vertices) continue;
    const std::size_t here = count_words(*line);
    if (lines == 0) words = here;
    if (here != words) return false;
  }
  const std::uint64_t needed = counts.vertices + counts.faces;
  return lines >= needed && words >= (lines == needed ? 3 : kind.words);
}

void read_vertices(TextScanner& scanner, const Counts& counts, const VertexKind& kind,
                   std::vector<double>& coordinates) {
  const bool lines = vertex_a_line(scanner, counts, kind);
  if (!lines && !counts.edges) {
    scanner.fail(
        "the number of edges is missing, and vertices and faces are not on lines of their own with equally "
        "many "
        "numbers for each vertex: the file is truncated, or add the number of edges (0 is enough)");
  }
  if (!lines && kind.coloured) {
    scanner.fail(
        "vertices and faces are not on lines of their own, and colours may have 3 or 4 numbers: the file is "
        "truncated, or put each on a line, with equally many numbers for each vertex");
  }
  for (std::size_t v = 0; v < counts.vertices; ++v) {
    for (int axis = 0; axis < 3; ++axis) coordinates.push_back(scanner.number({"vertex", v}));
    if (lines) {
      scanner.rest_of_line();
    } else {
      for (std::size_t more = 3; more < kind.words; ++more) scanner.number({"vertex", v});
    }
  }
  if (!lines && counts.vertices > 0 && !scanner.rest_of_line().empty()) {
    scanner.fail(
        fmt::format("the line continues after the last of {} vertices of {} numbers; put each vertex and "
                    "face on a line of its "
                    "own, with equally many numbers for each vertex",
                    counts.vertices, kind.words));
  }
}

}  // namespace

MeshFile parse_off(std::string_view text, const std::string& name) {
  TextScanner scanner(text, name);
  const VertexKind kind = read_header(scanner);
  const Counts counts = read_counts(scanner);
  scanner.check_count(counts.vertices, 6, "vertices");
  scanner.check_count(counts.faces, 4, "faces");

  MeshFile mesh;
  mesh.vertices.reserve(3 * checked_vertex_count(counts.vertices, name));
  read_vertices(scanner, counts, kind, mesh.vertices);
  for (std::size_t f = 0; f < counts.faces; ++f) {
    const auto corners = scanner.count({"face", f});
    scanner.check_count(corners, 2, "corners");
    for (std::size_t k = 0; k < corners; ++k) {
      mesh.face_vertex.push_back(scanner.index({"face", f}, counts.vertices));
    }
    scanner.rest_of_line();
    mesh.end_face();
  }
  if (!scanner.at_end()) {
    scanner.word({"end", 0});
    scanner.fail(fmt::format("more text after the {} faces announced", counts.faces));
  }
  return mesh;
}

}  // namespace powercell::io
