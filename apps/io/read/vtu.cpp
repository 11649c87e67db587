// VTU, VTK's XML file of an unstructured grid: arrays as text, inline base64, or appended (base64 or raw),
// plain or compressed by zlib; one or more pieces.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <pugixml.hpp>

#include "apps/io/read/file.hpp"
#include "apps/io/read/mesh.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/read/vtk_cells.hpp"
#include "apps/io/read/vtu_data.hpp"

namespace powercell::io {
namespace {

// Raw appended bytes are not XML and are removed before it is parsed.
struct Split {
  std::string xml;
  std::string_view appended;
};

Split split_appended(std::string_view bytes, const std::string& name) {
  const std::size_t tag = bytes.find("<AppendedData");
  if (tag == std::string_view::npos) return {std::string(bytes), {}};
  const std::size_t close = bytes.find('>', tag);
  const std::size_t begin = bytes.find('_', close == std::string_view::npos ? tag : close);
  if (begin == std::string_view::npos)
    fail_file(name, "AppendedData has no '_' before its bytes; the file is truncated");
  std::size_t end = bytes.rfind("</AppendedData>");
  if (end == std::string_view::npos || end < begin)
    fail_file(name, "AppendedData does not end; the file is truncated");
  return {std::string(bytes.substr(0, close + 1)) + std::string(bytes.substr(end)),
          bytes.substr(begin + 1, end - begin - 1)};
}

class VtuReader {
 public:
  VtuReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}
  MeshFile read();

 private:
  void read_storage(const pugi::xml_node& file);
  void read_piece(const pugi::xml_node& piece);
  template <class Number, class FromText, class FromBytes>
  std::vector<Number> array(const pugi::xml_node& node, FromText from_text, FromBytes from_bytes);
  std::vector<double> doubles(const pugi::xml_node& node);
  std::vector<std::int64_t> integers(const pugi::xml_node& node);
  pugi::xml_node named(const pugi::xml_node& parent, const char* array_name);
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const {
    const auto offset = node.offset_debug();
    if (offset < 0) fail_file(name_, what);
    fail_line(name_, line_of(bytes_, static_cast<std::size_t>(offset)), what);
  }

  std::string_view bytes_;
  std::string name_;
  VtuStorage storage_;
  MeshFile mesh_;
};

void VtuReader::read_storage(const pugi::xml_node& file) {
  const std::string_view type = file.attribute("type").value();
  if (type != "UnstructuredGrid") fail(file, fmt::format("VTKFile of type '{}', not UnstructuredGrid", type));
  const std::string_view order = file.attribute("byte_order").value();
  storage_.order = order == "BigEndian" ? std::endian::big : std::endian::little;
  storage_.header_bytes = std::string_view(file.attribute("header_type").value()) == "UInt64" ? 8 : 4;
  const std::string_view compressor = file.attribute("compressor").value();
  storage_.compressed = !compressor.empty();
  if (storage_.compressed && compressor != "vtkZLibDataCompressor") {
    fail(file, fmt::format("compressor '{}' is not read; save with zlib or without compression", compressor));
  }
  const pugi::xml_node appended = file.child("AppendedData");
  storage_.appended_raw = std::string_view(appended.attribute("encoding").value()) == "raw";
}

template <class Number, class FromText, class FromBytes>
std::vector<Number> VtuReader::array(const pugi::xml_node& node, FromText from_text, FromBytes from_bytes) {
  const std::string_view format = node.attribute("format").as_string("ascii");
  const std::string type = node.attribute("type").value();
  const std::string_view text = node.text().get();
  if (format == "ascii") {
    std::vector<Number> values;
    std::string_view rest = text, word;
    while (next_word(rest, word)) values.push_back(from_text(word));
    return values;
  }
  if (format == "binary") return from_bytes(decode_vtu_base64(text, storage_, name_), type);
  if (format != "appended") fail(node, fmt::format("format '{}' is not ascii, binary or appended", format));
  const unsigned long long offset = node.attribute("offset").as_ullong(~0ull);
  if (offset >= storage_.appended.size())
    fail(node, "the offset of an array lies behind the appended data; the file is truncated");
  const std::string_view from = storage_.appended.substr(offset);
  return from_bytes(storage_.appended_raw ? decode_vtu_raw(from, storage_, name_)
                                          : decode_vtu_base64(from, storage_, name_),
                    type);
}

std::vector<double> VtuReader::doubles(const pugi::xml_node& node) {
  const auto from_text = [&](std::string_view word) {
    double value = 0;
    const Parsed parsed = parse_number(word, value);
    if (parsed != Parsed::ok) fail(node, why_not(word, parsed));
    return value;
  };
  return array<double>(node, from_text, [&](const std::string& bytes, const std::string& type) {
    return vtu_doubles(bytes, type, storage_, name_);
  });
}

std::vector<std::int64_t> VtuReader::integers(const pugi::xml_node& node) {
  const auto from_text = [&](std::string_view word) {
    double value = 0;
    const Parsed parsed = parse_number(word, value);
    if (parsed != Parsed::ok || value != std::floor(value) || std::abs(value) > 9e15)
      fail(node, fmt::format("'{}' is not a whole number", word.substr(0, 40)));
    return static_cast<std::int64_t>(value);
  };
  return array<std::int64_t>(node, from_text, [&](const std::string& bytes, const std::string& type) {
    return vtu_integers(bytes, type, storage_, name_);
  });
}

pugi::xml_node VtuReader::named(const pugi::xml_node& parent, const char* array_name) {
  const pugi::xml_node node = parent.find_child_by_attribute("DataArray", "Name", array_name);
  if (!node) fail(parent, fmt::format("Cells lacks the DataArray '{}'", array_name));
  return node;
}

void VtuReader::read_piece(const pugi::xml_node& piece) {
  const std::uint64_t points = piece.attribute("NumberOfPoints").as_ullong(),
                      cell_count = piece.attribute("NumberOfCells").as_ullong();
  if (points == 0 && piece.attribute("NumberOfPoints") && cell_count == 0) return;  // with or without arrays
  const pugi::xml_node positions = piece.child("Points").child("DataArray");
  if (!positions) fail(piece, "a piece lacks the DataArray of its Points");
  const std::size_t base = mesh_.vertex_count();
  const std::vector<double> coordinates = doubles(positions);
  if (coordinates.size() / 3 != points || coordinates.size() % 3 != 0) {
    fail(positions,
         fmt::format(
             "{} coordinates, but {} points are announced; the file is truncated or the count is wrong",
             coordinates.size(), points));
  }
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    if (!std::isfinite(coordinates[k]))
      fail(positions, fmt::format("point {} (from 0) is not finite", k / 3));
  }
  mesh_.vertices.insert(mesh_.vertices.end(), coordinates.begin(), coordinates.end());
  checked_vertex_count(mesh_.vertex_count(), name_);

  const pugi::xml_node node = piece.child("Cells");
  VtkCells cells;
  if (cell_count == 0) return;
  cells.connectivity = integers(named(node, "connectivity"));
  cells.offset = integers(named(node, "offsets"));
  cells.type = integers(named(node, "types"));
  if (cells.offset.size() != cell_count || cells.type.size() != cell_count) {
    fail(node, fmt::format("{} offsets and {} types, but {} cells are announced", cells.offset.size(),
                           cells.type.size(), cell_count));
  }
  cells.offset.insert(cells.offset.begin(), 0);
  add_vtk_cells(cells, base, name_, mesh_);
}

MeshFile VtuReader::read() {
  const Split split = split_appended(bytes_, name_);
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(split.xml.data(), split.xml.size());
  if (!result) {
    fail_line(
        name_, line_of(split.xml, static_cast<std::size_t>(result.offset)),
        fmt::format("is not well-formed XML: {}; the file is truncated or damaged", result.description()));
  }
  const pugi::xml_node file = document.child("VTKFile");
  if (!file) fail_line(name_, 1, "has no element VTKFile");
  read_storage(file);
  storage_.appended = split.appended;
  for (const pugi::xml_node& piece : file.child("UnstructuredGrid").children("Piece")) read_piece(piece);
  if (mesh_.vertices.empty()) fail_file(name_, "has no points");
  return std::move(mesh_);
}

}  // namespace

MeshFile parse_vtu(std::string_view bytes, const std::string& name) {
  return VtuReader(bytes, name).read();
}

}  // namespace powercell::io
