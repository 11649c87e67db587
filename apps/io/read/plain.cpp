// Plain text meshes: the format of the paper's data (`nv nf`, points, polygons or tetrahedra) and .tet.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "apps/io/read/file.hpp"
#include "apps/io/read/polygons.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

// Rows of indices in one array; row r is [offset[r], offset[r + 1]).
struct Rows {
  std::vector<std::uint32_t> index;
  std::vector<std::size_t> offset{0};
  std::vector<std::size_t> line;

  std::size_t count() const { return line.size(); }
  std::size_t length(std::size_t row) const { return offset[row + 1] - offset[row]; }
  const std::uint32_t* begin(std::size_t row) const { return index.data() + offset[row]; }
};

std::size_t read_points(TextScanner& scanner, std::uint64_t count, std::vector<double>& coordinates) {
  std::size_t dimension = 0;
  for (std::size_t v = 0; v < count; ++v) {
    const auto line = scanner.line();
    if (!line) scanner.fail(fmt::format("the file ends after {} of {} points; it is truncated", v, count));
    std::string_view rest = *line, word;
    std::size_t columns = 0;
    while (next_word(rest, word)) {
      double value = 0;
      const Parsed parsed = parse_number(word, value);
      if (parsed != Parsed::ok) scanner.fail(fmt::format("point {} (from 0): {}", v, why_not(word, parsed)));
      if (++columns <= 3) coordinates.push_back(value);
    }
    if (v == 0) dimension = columns;
    if (columns != dimension || columns < 2 || columns > 3) {
      scanner.fail(fmt::format("point {} (from 0) has {} coordinates; every point needs 2, or every point 3",
                               v, columns));
    }
  }
  return dimension;
}

Rows read_rows(TextScanner& scanner, std::uint64_t count) {
  Rows rows;
  for (std::size_t f = 0; f < count; ++f) {
    const auto line = scanner.line();
    if (!line) scanner.fail(fmt::format("the file ends after {} of {} elements; it is truncated", f, count));
    std::string_view rest = *line, word;
    while (next_word(rest, word)) {
      std::uint32_t value = 0;
      const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (code != std::errc() || end != word.data() + word.size()) {
        scanner.fail(
            fmt::format("element {} (from 0): '{}' is not an index", f, std::string(word.substr(0, 40))));
      }
      rows.index.push_back(value);
    }
    rows.offset.push_back(rows.index.size());
    rows.line.push_back(scanner.line_number());
  }
  if (auto line = scanner.line())
    scanner.fail(fmt::format("more rows after the {} elements announced", count));
  return rows;
}

// Whether every row may begin with the number of its corners.
bool may_have_lengths(const Rows& rows) {
  for (std::size_t row = 0; row < rows.count(); ++row) {
    if (rows.length(row) < 2 || *rows.begin(row) != rows.length(row) - 1) return false;
  }
  return rows.count() > 0;
}

// The first point that no row uses if the first `skipped` numbers of each row are ignored; `points` if all
// are used.
std::size_t first_unused(const Rows& rows, std::size_t skipped, std::size_t points) {
  std::vector<bool> used(points);
  for (std::size_t row = 0; row < rows.count(); ++row) {
    for (std::size_t k = skipped; k < rows.length(row); ++k) {
      if (rows.begin(row)[k] < points) used[rows.begin(row)[k]] = true;
    }
  }
  return static_cast<std::size_t>(std::ranges::find(used, false) - used.begin());
}

// Refuses a file if the first number of every row could be the number of corners or a corner, and only as
// corners use all points.
void refuse_two_readings(const Rows& rows, std::size_t points, bool in_space, const std::string& name) {
  if (!may_have_lengths(rows)) return;
  for (std::size_t row = 0; row < rows.count(); ++row) {
    const std::uint32_t *first = rows.begin(row), *end = first + rows.length(row);
    if (rows.length(row) < 3 || *first >= points || std::find(first + 1, end, *first) != end) return;
  }
  const std::size_t unused = first_unused(rows, 1, points);
  if (unused == points || first_unused(rows, 0, points) != points) return;
  fail_line(name, rows.line.front(),
            fmt::format(
                "the first number of every row may be the number of corners, which leaves point {} (from 0) "
                "unused, or a corner itself; {}write the number of corners in front of every row, or remove "
                "unused points",
                unused, in_space ? "use --kind surface (numbers) or --kind volume (corners), or " : ""));
}

// Removes the numbers of corners if every row begins with its own. Rows of 4 numbers that begin with 3 are
// ambiguous: `as_tetrahedra` decides.
void drop_lengths(Rows& rows, bool as_tetrahedra) {
  bool all_four = true;
  for (std::size_t row = 0; row < rows.count(); ++row) all_four = all_four && rows.length(row) == 4;
  if (!may_have_lengths(rows) || (as_tetrahedra && all_four)) return;
  Rows bare;
  for (std::size_t row = 0; row < rows.count(); ++row) {
    bare.index.insert(bare.index.end(), rows.begin(row) + 1, rows.begin(row) + rows.length(row));
    bare.offset.push_back(bare.index.size());
  }
  bare.line = std::move(rows.line);
  rows = std::move(bare);
}

void check_indices(const Rows& rows, std::size_t vertices, const std::string& name) {
  const bool zero = std::find(rows.index.begin(), rows.index.end(), 0u) != rows.index.end();
  for (std::size_t row = 0; row < rows.count(); ++row) {
    for (const std::uint32_t* k = rows.begin(row); k != rows.begin(row) + rows.length(row); ++k) {
      if (*k < vertices) continue;
      const bool from_one = *k == vertices && !zero;
      fail_line(
          name, rows.line[row],
          fmt::format(
              "element {} (from 0): index {} is out of range; the file has {} points, numbered from 0{}", row,
              *k, vertices, from_one ? " (this file seems to count from 1: subtract 1)" : ""));
    }
  }
}

DomainArrays polygons(const std::vector<double>& coordinates, const Rows& rows, const std::string& name) {
  std::vector<std::vector<PolygonPart>> groups;
  for (std::size_t row = 0; row < rows.count(); ++row) {
    if (rows.length(row) < 3)
      fail_line(name, rows.line[row],
                fmt::format("polygon {} (from 0) has {} corners; it needs 3", row, rows.length(row)));
    PolygonPart part;
    for (std::size_t k = 0; k < rows.length(row); ++k) {
      const std::size_t v = rows.begin(row)[k];
      part.outer.push_back({coordinates[2 * v], coordinates[2 * v + 1]});
    }
    groups.push_back({std::move(part)});
  }
  DomainArrays arrays;
  arrays.parts = unite(groups, name);
  return arrays;
}

MeshFile mesh_of(std::vector<double> coordinates, const Rows& rows, bool tetrahedra,
                 const std::string& name) {
  MeshFile mesh;
  mesh.vertices = std::move(coordinates);
  if (!tetrahedra) {
    mesh.face_vertex = rows.index;
    mesh.face_offset = rows.offset;
    return mesh;
  }
  for (std::size_t row = 0; row < rows.count(); ++row) {
    if (rows.length(row) != 4)
      fail_line(
          name, rows.line[row],
          fmt::format("element {} (from 0) has {} corners; a tetrahedron has 4", row, rows.length(row)));
  }
  mesh.tetrahedra = rows.index;
  return mesh;
}

struct PlainCounts {
  std::uint64_t vertices, elements;
};

// `nv nf`, with or without words after the numbers ("10 vertices" and "4 tets" on separate lines).
PlainCounts read_plain_counts(TextScanner& scanner) {
  PlainCounts counts{};
  counts.vertices = scanner.count({"number of points", 0});
  if (scanner.peek() == "vertices") scanner.word({"header", 0});
  counts.elements = scanner.count({"number of elements", 0});
  if (scanner.peek() == "tets" || scanner.peek() == "cells") scanner.word({"header", 0});
  if (!scanner.rest_of_line().empty()) scanner.fail("the first line is not `points elements`, two counts");
  scanner.check_count(counts.vertices, 4, "points");
  scanner.check_count(counts.elements, 2, "elements");
  if (counts.vertices == 0) scanner.fail("announces no points");
  if (counts.elements == 0) scanner.fail("announces no elements");
  return counts;
}

}  // namespace

DomainArrays parse_plain(std::string_view text, std::optional<DomainKind> kind, const std::string& name) {
  TextScanner scanner(text, name);
  const PlainCounts counts = read_plain_counts(scanner);
  std::vector<double> coordinates;
  const std::size_t dimension = read_points(scanner, counts.vertices, coordinates);
  Rows rows = read_rows(scanner, counts.elements);
  if (dimension == 2 || !kind) refuse_two_readings(rows, counts.vertices, dimension == 3, name);
  drop_lengths(rows, dimension == 3 && kind == DomainKind::volume);
  check_indices(rows, checked_vertex_count(counts.vertices, name), name);
  if (dimension == 2) {
    if (kind.value_or(DomainKind::polygon) != DomainKind::polygon)
      fail_file(name, "has points of 2 coordinates: a polygon, not a mesh in space");
    return polygons(coordinates, rows, name);
  }
  bool all_four = true;
  for (std::size_t row = 0; row < rows.count(); ++row) all_four = all_four && rows.length(row) == 4;
  const bool tetrahedra = kind ? *kind == DomainKind::volume : all_four;
  MeshArrays mesh = choose_elements(mesh_of(std::move(coordinates), rows, tetrahedra, name), kind, name);
  DomainArrays arrays;
  arrays.kind = mesh.kind;
  arrays.vertices = std::move(mesh.vertices);
  arrays.elements = std::move(mesh.elements);
  return arrays;
}

MeshFile parse_tet(std::string_view text, const std::string& name) {
  TextScanner scanner(text, name);
  const PlainCounts counts = read_plain_counts(scanner);
  std::vector<double> coordinates;
  if (read_points(scanner, counts.vertices, coordinates) != 3)
    fail_file(name, "has points of 2 coordinates; tetrahedra need 3");
  Rows rows = read_rows(scanner, counts.elements);
  drop_lengths(rows, true);
  check_indices(rows, checked_vertex_count(counts.vertices, name), name);
  return mesh_of(std::move(coordinates), rows, true, name);
}

}  // namespace powercell::io
