// Legacy VTK, ASCII and binary (big-endian): UNSTRUCTURED_GRID and POLYDATA, with cells as before and
// after version 5.1 of the format. Reading ends at the data of points and cells, which are not needed.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "apps/io/read/bytes.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/mesh.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/read/vtk_cells.hpp"

namespace powercell::io {
namespace {

using Type = NumberType;

class LegacyReader {
 public:
  LegacyReader(std::string_view bytes, const std::string& name)
      : text_(bytes, name, '\0'), bytes_(bytes, name, std::endian::big), name_(name) {}

  MeshFile read();

 private:
  void read_header();
  bool read_section(const std::string& keyword);  // false where reading can end
  void read_points();
  void read_cells();
  std::int64_t whole_number(double value, const char* what) const;
  void read_cell_types();
  void skip_field();
  void skip_values(std::uint64_t count, std::size_t array);
  void skip_strings(std::uint64_t count);
  void skip_metadata();
  std::string keyword();
  Type type() { return type_named(keyword()); }
  Type type_named(const std::string& word) const;
  template <class Take>
  void values(std::uint64_t count, Type type, Item item, Take take);

  TextScanner text_;
  ByteScanner bytes_;
  std::string name_;
  bool ascii_ = true;
  bool grid_ = true;  // UNSTRUCTURED_GRID, else POLYDATA
  VtkCells cells_;
  MeshFile mesh_;
};

std::string LegacyReader::keyword() {
  std::string word(text_.word({"section", 0}));
  for (char& c : word) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return word;
}

Type LegacyReader::type_named(const std::string& word) const {
  constexpr std::pair<std::string_view, Type> types[] = {
      {"DOUBLE", Type::f64},       {"FLOAT", Type::f32},          {"INT", Type::i32},
      {"UNSIGNED_INT", Type::u32}, {"LONG", Type::i64},           {"UNSIGNED_LONG", Type::u64},
      {"VTKTYPEINT64", Type::i64}, {"VTKIDTYPE", Type::i32},      {"VTKTYPEUINT64", Type::u64},
      {"SHORT", Type::i16},        {"UNSIGNED_SHORT", Type::u16}, {"CHAR", Type::i8},
      {"UNSIGNED_CHAR", Type::u8}};
  for (const auto& [known, type] : types) {
    if (word == known) return type;
  }
  text_.fail(fmt::format("'{}' is not a type of numbers that is read", word.substr(0, 40)));
}

// Calls `take` with each of `count` numbers, from text or from the bytes after the line end.
template <class Take>
void LegacyReader::values(std::uint64_t count, Type type, Item item, Take take) {
  if (ascii_) {
    text_.check_count(count, 2, item.thing);
    for (std::uint64_t k = 0; k < count; ++k) take(text_.number({item.thing, static_cast<std::size_t>(k)}));
    return;
  }
  text_.rest_of_line();
  bytes_.seek(text_.offset());
  bytes_.need(count, size_of(type), item.thing);
  for (std::uint64_t k = 0; k < count; ++k) take(bytes_.next(type, item.thing));
  text_.seek(bytes_.offset());
}

void LegacyReader::read_header() {
  if (!text_.rest_of_line().starts_with("# vtk DataFile Version")) {
    text_.fail("does not begin with '# vtk DataFile Version'");
  }
  text_.rest_of_line();  // title
  const std::string format = keyword();
  if (format != "ASCII" && format != "BINARY") text_.fail("ASCII or BINARY expected");
  ascii_ = format == "ASCII";
  if (keyword() != "DATASET") text_.fail("DATASET expected");
  const std::string dataset = keyword();
  grid_ = dataset == "UNSTRUCTURED_GRID";
  if (!grid_ && dataset != "POLYDATA") {
    text_.fail(
        fmt::format("data set {} is not read, only UNSTRUCTURED_GRID and POLYDATA", dataset.substr(0, 40)));
  }
}

void LegacyReader::read_points() {
  const auto count = text_.count({"number of points", 0});
  const Type kind = type();
  checked_vertex_count(count, name_);
  if (!mesh_.vertices.empty()) text_.fail("a second section POINTS");
  values(3 * count, kind, {"coordinate", 0}, [this](double value) {
    if (!std::isfinite(value))
      bytes_.fail(fmt::format("point {} (from 0) is not finite", mesh_.vertex_count()));
    mesh_.vertices.push_back(value);
  });
}

// Indices above 2^53 are not exact as doubles, but out of range anyway.
std::int64_t LegacyReader::whole_number(double value, const char* what) const {
  if (!(std::abs(value) < 9e15)) text_.fail(fmt::format("{} is out of range", what));
  if (value != std::floor(value)) text_.fail(fmt::format("{} is {}, not a whole number", what, value));
  return static_cast<std::int64_t>(value);
}

// Reads one section of cells: `n size` and rows `k i0 ...`, or offsets and connectivity.
void LegacyReader::read_cells() {
  const auto first = text_.count({"number of cells", 0});
  const auto second = text_.count({"size of cells", 0});
  const auto whole = [this](double value) { return whole_number(value, "an index of a cell"); };
  if (cells_.offset.empty()) cells_.offset.push_back(0);
  const auto base = static_cast<std::int64_t>(cells_.connectivity.size());
  if (text_.peek() == "OFFSETS") {
    text_.word({"OFFSETS", 0});
    std::vector<std::int64_t> offset;
    values(first, type(), {"offset", 0}, [&](double value) { offset.push_back(whole(value)); });
    if (keyword() != "CONNECTIVITY") text_.fail("CONNECTIVITY expected");
    values(second, type(), {"index", 0}, [&](double value) { cells_.connectivity.push_back(whole(value)); });
    for (std::size_t k = 1; k < offset.size(); ++k) cells_.offset.push_back(base + offset[k]);
    return;
  }
  std::int64_t left = 0;
  std::uint64_t rows = 0;
  values(second, Type::i32, {"index", 0}, [&](double value) {
    if (left == 0) {
      left = whole(value);
      if (left < 0) text_.fail(fmt::format("cell {} (from 0) has {} corners", rows, left));
      ++rows;
      cells_.offset.push_back(cells_.offset.back() + left);
    } else {
      cells_.connectivity.push_back(whole(value));
      --left;
    }
  });
  if (rows != first || left != 0) {
    text_.fail(fmt::format("{} cells are announced, but the {} numbers of the section hold {}", first, second,
                           rows));
  }
}

void LegacyReader::read_cell_types() {
  const auto count = text_.count({"number of cells", 0});
  values(count, Type::i32, {"cell type", 0},
         [this](double value) { cells_.type.push_back(whole_number(value, "a cell type")); });
}

// In binary files VTK writes a length before each string; its highest two bits are the size of the length.
void LegacyReader::skip_strings(std::uint64_t count) {
  text_.rest_of_line();
  if (ascii_) {
    text_.check_count(count, 1, "strings");
    for (std::uint64_t k = 0; k < count; ++k) text_.rest_of_line();
    return;
  }
  bytes_.seek(text_.offset());
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto first = bytes_.next<std::uint8_t>("a string");
    std::uint64_t length = first & 0x3f;
    const int more = first >= 0xc0 ? 0 : first >= 0x80 ? 1 : first >= 0x40 ? 3 : 7;
    for (int byte = 0; byte < more; ++byte) length = length << 8 | bytes_.next<std::uint8_t>("a string");
    bytes_.skip(length, 1, "a string");
  }
  text_.seek(bytes_.offset());
}

void LegacyReader::skip_values(std::uint64_t count, std::size_t array) {
  const std::string word = keyword();
  if (word == "STRING") return skip_strings(count);
  const bool bits = word == "BIT";
  const std::size_t size = bits ? 1 : size_of(type_named(word));
  if (ascii_) {
    text_.check_count(count, 2, "values");
    for (std::uint64_t k = 0; k < count; ++k) text_.word({"array", array});  // may be nan
    return;
  }
  text_.rest_of_line();
  bytes_.seek(text_.offset());
  bytes_.skip(bits ? count / 8 + (count % 8 != 0 ? 1 : 0) : count, size, "an array of a field");
  text_.seek(bytes_.offset());
}

void LegacyReader::skip_metadata() {
  text_.rest_of_line();
  while (text_.offset() < text_.text().size() && !text_.rest_of_line().empty()) {  // up to an empty line
  }
}

void LegacyReader::skip_field() {
  text_.word({"field", 0});
  const auto arrays = text_.count({"number of arrays", 0});
  for (std::uint64_t k = 0; k < arrays; ++k) {
    text_.word({"array", k});
    const auto components = text_.count({"components of array", k});
    const auto tuples = text_.count({"tuples of array", k});
    // A byte may hold eight bits.
    if (components != 0 && tuples / 8 > text_.text().size() / components)
      text_.fail("the size of an array is wrong");
    skip_values(components * tuples, k);
    if (text_.peek() == "METADATA") {
      text_.word({"array", k});
      skip_metadata();
    }
  }
}

bool LegacyReader::read_section(const std::string& keyword) {
  if (keyword == "POINTS") {
    read_points();
  } else if (keyword == "CELLS" || keyword == "POLYGONS" || keyword == "TRIANGLE_STRIPS" ||
             keyword == "LINES" || keyword == "VERTICES") {
    if (grid_ != (keyword == "CELLS"))
      text_.fail(fmt::format("{} does not belong to this data set", keyword));
    read_cells();
    // The cell type of each section: 2 points, 4 lines, 6 strips, 7 polygons.
    const int type = keyword == "POLYGONS"          ? 7
                     : keyword == "TRIANGLE_STRIPS" ? 6
                     : keyword == "LINES"           ? 4
                                                    : 2;
    if (!grid_) cells_.type.resize(cells_.offset.size() - 1, type);
  } else if (keyword == "CELL_TYPES") {
    read_cell_types();
  } else if (keyword == "FIELD") {
    skip_field();
  } else if (keyword == "METADATA") {
    skip_metadata();
  } else if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
    return false;
  } else {
    text_.fail(fmt::format("'{}' instead of a section; the count above is wrong", keyword.substr(0, 40)));
  }
  return true;
}

MeshFile LegacyReader::read() {
  read_header();
  while (!text_.at_end() && read_section(keyword())) {
  }
  if (mesh_.vertices.empty()) fail_file(name_, "has no section POINTS");
  const std::size_t cells = cells_.offset.empty() ? 0 : cells_.offset.size() - 1;
  if (cells_.type.size() != cells) {
    fail_file(name_, fmt::format("has {} cells but {} cell types; the file is truncated", cells,
                                 cells_.type.size()));
  }
  add_vtk_cells(cells_, 0, name_, mesh_);
  return std::move(mesh_);
}

}  // namespace

MeshFile parse_vtk(std::string_view bytes, const std::string& name) {
  return LegacyReader(bytes, name).read();
}

}  // namespace powercell::io
