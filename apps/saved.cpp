#include "apps/saved.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/io/read_file.hpp"

namespace powercell::app {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  io::fail_file(path, what + "; a saved diagram is what 'powercell diagram -o FILE.json' writes");
}

// A number that may be missing (null) reads as not a number.
double number(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

// Not by get<std::size_t>(), which turns 1e80 and -1 into some other number.
std::size_t count(const json& value) {
  if (!value.is_number_unsigned())
    throw std::invalid_argument(fmt::format("{} is no count", value.dump().substr(0, 40)));
  return value.get<std::size_t>();
}

SeedStatus status_of(const std::string& name) {
  if (name == "ok") return SeedStatus::ok;
  if (name == "hidden") return SeedStatus::hidden;
  if (name == "duplicate") return SeedStatus::duplicate;
  throw std::invalid_argument("unknown status '" + name + "'");
}

DomainKind kind_of(const std::string& name) {
  if (name == "polygon") return DomainKind::polygon;
  if (name == "surface") return DomainKind::surface;
  if (name == "volume") return DomainKind::volume;
  throw std::invalid_argument("unknown kind of domain '" + name + "'");
}

std::optional<std::int64_t> border_of(const json& value, std::size_t cells) {
  if (value.is_null()) return std::nullopt;
  if (!value.is_number_integer())
    throw std::invalid_argument(fmt::format("the border {} is no integer", value.dump().substr(0, 40)));
  if (value.is_number_unsigned() && value.get<std::uint64_t>() >= cells)
    throw std::invalid_argument("a border names a seed there is not");
  return value.get<std::int64_t>();
}

SavedFace face_of(const json& loop, const json& border, bool volume, std::size_t vertices,
                  std::size_t cells) {
  SavedFace face;
  for (const json& place : loop) {
    const std::size_t v = count(place);
    if (v >= vertices) throw std::invalid_argument("a face names a vertex there is not");
    face.loop.push_back(static_cast<std::uint32_t>(v));
  }
  if (volume) {
    face.border.push_back(border_of(border, cells));
  } else {
    for (const json& edge : border) face.border.push_back(border_of(edge, cells));
    if (face.border.size() != face.loop.size())
      throw std::invalid_argument("borders and edges differ in number");
  }
  return face;
}

SavedCell cell_of(const json& from, const SavedDiagram& diagram, std::size_t cells) {
  SavedCell cell;
  cell.position = from.at("position").get<std::vector<double>>();
  if (cell.position.size() != static_cast<std::size_t>(diagram.dimension))
    throw std::invalid_argument("'position' has the wrong number of coordinates");
  cell.weight = from.at("weight").get<double>();
  cell.measure = number(from.at("measure"));
  cell.status = status_of(from.at("status").get<std::string>());
  if (from.contains("centroid") && !from["centroid"].is_null()) {
    cell.centroid = from["centroid"].get<std::vector<double>>();
    if (cell.centroid.size() != cell.position.size())
      throw std::invalid_argument("'centroid' has the wrong number of coordinates");
  }
  for (const json& vertex : from.at("vertices")) {
    const auto x = vertex.get<std::vector<double>>();
    if (x.size() != cell.position.size())
      throw std::invalid_argument("a vertex has the wrong number of coordinates");
    cell.vertices.insert(cell.vertices.end(), x.begin(), x.end());
  }
  const json& faces = from.at("faces");
  const json& borders = from.at("borders");
  if (faces.size() != borders.size()) throw std::invalid_argument("'faces' and 'borders' differ in number");
  const std::size_t vertices = cell.vertices.size() / cell.position.size();
  for (std::size_t f = 0; f < faces.size(); ++f)
    cell.faces.push_back(face_of(faces[f], borders[f], diagram.kind == DomainKind::volume, vertices, cells));
  return cell;
}

SavedSummary summary_of(const json& from) {
  return {count(from.at("cells")), count(from.at("hidden")), count(from.at("duplicate")),
          number(from.at("measure")), number(from.at("domain_measure"))};
}

}  // namespace

SavedDiagram parse_saved(std::string_view bytes, const std::string& name) {
  SavedDiagram diagram;
  std::size_t reading = 0;
  bool in_cells = false;
  try {
    const json whole = json::parse(bytes);
    diagram.kind = kind_of(whole.at("domain").at("kind").get<std::string>());
    diagram.dimension = diagram.kind == DomainKind::polygon ? 2 : 3;
    diagram.domain_measure = whole.at("domain").at("measure").get<double>();
    if (whole.contains("check")) diagram.summary = summary_of(whole["check"]);
    const json& cells = whole.at("cells");
    in_cells = true;
    for (; reading < cells.size(); ++reading)
      diagram.cells.push_back(cell_of(cells[reading], diagram, cells.size()));
  } catch (const json::parse_error& error) {
    refuse(name, fmt::format("not JSON at byte {}", error.byte));
  } catch (const std::exception& error) {
    refuse(name, in_cells ? fmt::format("cell {}: {}", reading, error.what()) : std::string(error.what()));
  }
  return diagram;
}

SavedDiagram read_saved(const std::string& path) {
  return parse_saved(io::read_file(path), path);
}

}  // namespace powercell::app
