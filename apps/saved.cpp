#include "apps/saved.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/io/names.hpp"
#include "apps/io/read/file.hpp"

namespace powercell::app {
namespace {

using nlohmann::json;

// A missing number (null) reads as not a number.
double number(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

// Not get<std::size_t>(), which converts 1e80 and -1 to other numbers.
std::size_t count(const json& value) {
  if (!value.is_number_unsigned())
    throw std::invalid_argument(fmt::format("{} is not a count", value.dump().substr(0, 40)));
  return value.get<std::size_t>();
}

// \param find  io::domain_kind or io::seed_status
template <class Value>
Value named(const json& name, std::optional<Value> (*find)(std::string_view), const char* thing) {
  if (const auto value = find(name.get<std::string>())) return *value;
  throw std::invalid_argument(fmt::format("unknown {} {}", thing, name.dump().substr(0, 40)));
}

Border border_of(const json& value, std::size_t cells) {
  if (value.is_null()) return {Border::Kind::interior, 0};
  if (!value.is_number_integer())
    throw std::invalid_argument(fmt::format("the border {} is not an integer", value.dump().substr(0, 40)));
  if (value.is_number_unsigned()) {
    if (value.get<std::uint64_t>() >= cells)
      throw std::invalid_argument("a border names a seed that does not exist");
    return {Border::Kind::wall, value.get<std::uint32_t>()};
  }
  const std::int64_t facet = -1 - value.get<std::int64_t>();
  if (facet > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("a border names a facet that does not exist");
  return {Border::Kind::boundary, static_cast<std::uint32_t>(facet)};
}

class Reader {
 public:
  SavedFile read(const json& whole) {
    if (whole.at("domain").contains("periods"))
      throw std::invalid_argument(
          "the diagram is periodic; only bounded ones can be verified from their file");
    file_.kind = named(whole.at("domain").at("kind"), io::domain_kind, "kind of domain");
    file_.cells.dimension = file_.measures.dimension = file_.kind == DomainKind::polygon ? 2 : 3;
    file_.cells.cell_dimension = file_.kind == DomainKind::volume ? 3 : 2;
    file_.measures.domain_measure = whole.at("domain").at("measure").get<double>();
    if (whole.contains("check")) {
      const json& from = whole["check"];
      file_.summary = {count(from.at("cells")), count(from.at("hidden")), count(from.at("duplicate")),
                       number(from.at("measure")), number(from.at("domain_measure"))};
    }
    file_.cells.vertex_offset = file_.cells.face_offset = file_.cells.loop_offset = {0};
    const json& cells = whole.at("cells");
    for (std::size_t i = 0; i < cells.size(); ++i) {
      try {
        add_cell(cells[i], cells.size());
      } catch (const std::exception& error) {
        throw std::invalid_argument(fmt::format("cell {}: {}", i, error.what()));
      }
    }
    if (cells.empty() && !file_.summary) throw std::invalid_argument("no cells, and no 'check' that says so");
    if (!has_centroids_) file_.measures.centroid.clear();
    return std::move(file_);
  }

 private:
  void add_point(std::vector<double>& points, const json& from, const char* thing) const {
    const auto point = from.get<std::vector<double>>();
    if (point.size() != static_cast<std::size_t>(file_.cells.dimension))
      throw std::invalid_argument(fmt::format("{} has the wrong number of coordinates", thing));
    points.insert(points.end(), point.begin(), point.end());
  }

  void add_cell(const json& from, std::size_t cells) {
    add_point(file_.positions, from.at("position"), "'position'");
    file_.weights.push_back(from.at("weight").get<double>());
    Measures& measures = file_.measures;
    measures.mass.push_back(number(from.at("measure")));
    measures.status.push_back(named(from.at("status"), io::seed_status, "status"));
    measures.centroid.resize(file_.positions.size(), std::numeric_limits<double>::quiet_NaN());
    if (from.contains("centroid") && !from["centroid"].is_null()) {
      has_centroids_ = true;
      measures.centroid.resize(file_.positions.size() - static_cast<std::size_t>(measures.dimension));
      add_point(measures.centroid, from["centroid"], "'centroid'");
    }
    for (const json& vertex : from.at("vertices")) add_point(file_.cells.vertices, vertex, "a vertex");
    const json &faces = from.at("faces"), &borders = from.at("borders");
    if (faces.size() != borders.size()) throw std::invalid_argument("'faces' and 'borders' differ in number");
    for (std::size_t f = 0; f < faces.size(); ++f)
      add_face(faces[f], borders[f], from["vertices"].size(), cells);
    file_.cells.vertex_offset.push_back(file_.cells.vertices.size() /
                                        static_cast<std::size_t>(file_.cells.dimension));
    file_.cells.face_offset.push_back(file_.cells.loop_offset.size() - 1);
  }

  void add_face(const json& loop, const json& border, std::size_t vertices, std::size_t cells) {
    if (loop.size() < 3) throw std::invalid_argument("a face has fewer than 3 corners");
    for (const json& place : loop) {
      const std::size_t v = count(place);
      if (v >= vertices) throw std::invalid_argument("a face names a vertex that does not exist");
      file_.cells.loop.push_back(static_cast<std::uint32_t>(v));
    }
    file_.cells.loop_offset.push_back(file_.cells.loop.size());
    if (file_.kind == DomainKind::volume) {
      file_.cells.face_border.push_back(border_of(border, cells));
      return;
    }
    if (border.size() != loop.size()) throw std::invalid_argument("borders and edges differ in number");
    for (const json& edge : border) file_.cells.edge_border.push_back(border_of(edge, cells));
  }

  SavedFile file_;
  bool has_centroids_ = false;
};

LawCheck check_summary(const SavedSummary& summary, const Measures& measures) {
  LawCheck law{"summary: 'check' agrees with the cells", true, 0, 1e-11, {}};
  const auto compare = [&law](const char* thing, double stated, double found, double scale) {
    const double off = std::abs(stated - found) / scale;
    if (off <= law.value) return;
    law.value = off;
    law.passed = off <= law.tolerance;
    law.detail = fmt::format("'check' has {} {:.17g}, the cells have {:.17g}", thing, stated, found);
  };
  const auto seeds = [&](const char* thing, std::size_t stated, SeedStatus status) {
    compare(thing, static_cast<double>(stated), static_cast<double>(measures.count(status)), 1);
  };
  seeds("cells", summary.cells, SeedStatus::ok);
  seeds("hidden seeds", summary.hidden, SeedStatus::hidden);
  seeds("duplicates", summary.duplicate, SeedStatus::duplicate);
  compare("the measure", summary.measure, measures.total(), measures.domain_measure);
  compare("the domain's measure", summary.domain_measure, measures.domain_measure, measures.domain_measure);
  return law;
}

}  // namespace

SavedFile parse_saved(std::string_view bytes, const std::string& name) {
  const auto refuse = [&name](const std::string& fault) {
    io::fail_file(name, fault + "; a saved diagram is a file that 'powercell diagram -o FILE.json' writes");
  };
  SavedFile file;
  try {
    file = Reader().read(json::parse(bytes));
  } catch (const json::parse_error& error) {
    refuse(fmt::format("not JSON at byte {}", error.byte));
  } catch (const std::exception& error) {
    refuse(error.what());
  }
  return file;
}

SavedFile read_saved(const std::string& path) {
  return parse_saved(io::read_file(path), path);
}

std::vector<LawCheck> check_saved(const SavedFile& file, Precision precision, const VerifyOptions& options) {
  const SeedsView seeds{file.cells.dimension, file.positions, file.weights};
  std::vector<LawCheck> laws = verify({file.kind, precision, seeds, file.measures, file.cells}, options);
  if (file.summary) laws.insert(laws.begin() + 1, check_summary(*file.summary, file.measures));
  return laws;
}

}  // namespace powercell::app
