#include "apps/io/read/geopackage.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "apps/io/read/file.hpp"
#include "apps/io/read/geos.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

struct Layer {
  std::string table, column, type, crs;
};

/// Path of the file and name of the layer, empty if none is named.
std::pair<std::string, std::string> split(const std::string& name) {
  constexpr std::string_view extension = ".gpkg";
  const std::size_t at = lower_case(name).rfind(extension);
  if (at == std::string::npos) return {};
  const std::size_t end = at + extension.size();
  if (end == name.size()) return {name, ""};
  if (name[end] != ':' || name.find('/', end) != std::string::npos) return {};
  return {name.substr(0, end), name.substr(end + 1)};
}

/// The rows of a query.
class Query {
 public:
  Query(sqlite3* database, const std::string& name, const std::string& text)
      : database_(database), name_(name) {
    sqlite3_stmt* statement = nullptr;
    check(sqlite3_prepare_v2(database, text.c_str(), -1, &statement, nullptr));
    statement_.reset(statement);
  }

  bool next() {
    const int code = sqlite3_step(statement_.get());
    if (code != SQLITE_ROW && code != SQLITE_DONE) check(code);
    return code == SQLITE_ROW;
  }
  int columns() const { return sqlite3_column_count(statement_.get()); }
  std::string column_name(int k) const { return sqlite3_column_name(statement_.get(), k); }
  int type(int k) const { return sqlite3_column_type(statement_.get(), k); }
  std::string text(int k) const {
    if (type(k) == SQLITE_FLOAT) return fmt::format("{}", sqlite3_column_double(statement_.get(), k));
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), k));
    if (bytes == nullptr) return {};
    return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), k))};
  }
  std::string_view blob(int k) const {
    const void* bytes = sqlite3_column_blob(statement_.get(), k);
    if (bytes == nullptr) return {};
    return {static_cast<const char*>(bytes),
            static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), k))};
  }

 private:
  void check(int code) const {
    if (code != SQLITE_OK)
      fail_file(name_, fmt::format("is not a GeoPackage that can be read: {}", sqlite3_errmsg(database_)));
  }
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  sqlite3* database_;
  const std::string& name_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

std::string identifier(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

class GeoPackage {
 public:
  explicit GeoPackage(const std::string& name) : name_(name) {
    const auto [path, layer] = split(name);
    layer_ = layer;
    if (!std::filesystem::is_regular_file(path)) read_file(path);  // says what is wrong with it
    sqlite3* database = nullptr;
    const int code = sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr);
    database_.reset(database);
    if (code != SQLITE_OK) fail_file(name, fmt::format("cannot be opened: {}", sqlite3_errmsg(database)));
  }

  /// The layer that is named, else the only one whose type has `type` in its name, "POINT" or "POLYGON".
  Layer layer(std::string_view type) {
    std::vector<Layer> layers;
    std::string all;
    Query query =
        ask("SELECT g.table_name, g.column_name, upper(g.geometry_type_name), s.organization, "
            "s.organization_coordsys_id, s.definition, g.srs_id FROM gpkg_geometry_columns g "
            "LEFT JOIN gpkg_spatial_ref_sys s ON s.srs_id = g.srs_id");
    while (query.next()) {
      Layer layer{query.text(0), query.text(1), query.text(2), {}};
      const std::string authority = lower_case(query.text(3)), system = query.text(6);
      if (system != "0" && system != "-1")  // these are undefined
        layer.crs = authority.empty() || authority == "none"
                        ? query.text(5)
                        : fmt::format("{}:{}", query.text(3), query.text(4));
      all += fmt::format("{}{} ({})", all.empty() ? "" : ", ", layer.table, lower_case(layer.type));
      const bool fits = layer.type.find(type) != std::string::npos || layer.type.starts_with("GEOMETRY");
      if (layer_.empty() ? fits : layer.table == layer_) layers.push_back(std::move(layer));
    }
    if (layers.size() == 1) return layers[0];
    if (!layer_.empty()) fail_file(name_, fmt::format("has no layer of that name; it has {}", all));
    fail_file(name_,
              fmt::format("has {} layers of {}s; it has {}{}", layers.size(), lower_case(type), all,
                          layers.size() > 1 ? fmt::format("; name one: FILE.gpkg:{}", layers[0].table) : ""));
  }

  Query rows(const Layer& layer) { return ask("SELECT * FROM " + identifier(layer.table)); }

  /// A geometry from its blob: a header, then well-known binary. Null if it is missing.
  Geos::Geometry geometry(std::string_view blob, std::size_t row) {
    if (blob.empty()) return geos_.own(nullptr);
    constexpr std::array<std::size_t, 8> envelope = {0, 32, 48, 48, 64, 0, 0, 0};
    if (blob.size() < 8 || !blob.starts_with("GP")) fail(row, "its geometry is not one of a GeoPackage");
    const std::size_t header = 8 + envelope[(static_cast<unsigned char>(blob[3]) >> 1) & 7];
    if (blob.size() <= header) fail(row, "its geometry is truncated");
    Geos::Geometry geometry = geos_.own(GEOSGeomFromWKB_buf_r(
        geos_.handle(), reinterpret_cast<const unsigned char*>(blob.data()) + header, blob.size() - header));
    if (!geometry) fail(row, "its geometry cannot be read: " + geos_.message());
    return geometry;
  }

  [[noreturn]] void fail(std::size_t row, const std::string& what) const {
    fail_file(name_, fmt::format("feature {} (from 0): {}", row, what));
  }
  const Geos& geos() const { return geos_; }

 private:
  Query ask(const std::string& text) { return {database_.get(), name_, text}; }

  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
  };
  std::string name_, layer_;
  std::unique_ptr<sqlite3, Close> database_;
  Geos geos_;
};

/// The column of geometries.
int geometry_column(const Query& rows, const Layer& layer, const std::string& name) {
  for (int k = 0; k < rows.columns(); ++k)
    if (lower_case(rows.column_name(k)) == lower_case(layer.column)) return k;
  fail_file(name, fmt::format("layer {} has no column {} of geometries", layer.table, layer.column));
}

}  // namespace

bool is_geopackage(const std::string& name) {
  return !split(name).first.empty();
}

FeatureRows read_geopackage_points(const std::string& name, std::size_t dimension) {
  GeoPackage file(name);
  const Layer layer = file.layer("POINT");
  Query query = file.rows(layer);
  const int column = geometry_column(query, layer, name);
  std::vector<std::string> attributes;
  for (int k = 0; k < query.columns(); ++k)
    if (k != column) attributes.push_back(query.column_name(k));
  FeatureRows rows(name, dimension, attributes);
  rows.crs.name = layer.crs;
  while (query.next()) {
    std::vector<std::string> values;
    for (int k = 0; k < query.columns(); ++k)
      if (k != column) values.push_back(query.type(k) == SQLITE_BLOB ? "" : query.text(k));
    const Geos::Geometry geometry = file.geometry(query.blob(column), rows.count());
    if (!geometry) file.fail(rows.count(), "has no point; remove it, or give it one");
    std::array<double, 3> point{};
    const std::string fault = file.geos().point(geometry.get(), point);
    if (!fault.empty()) file.fail(rows.count(), "is " + fault);
    rows.add(point, values);
  }
  return rows;
}

std::vector<PolygonPart> read_geopackage_polygons(const std::string& name, NamedCrs* crs) {
  GeoPackage file(name);
  const Layer layer = file.layer("POLYGON");
  Query query = file.rows(layer);
  const int column = geometry_column(query, layer, name);
  std::vector<std::vector<PolygonPart>> groups;
  for (std::size_t row = 0; query.next(); ++row) {
    const Geos::Geometry geometry = file.geometry(query.blob(column), row);
    if (!geometry) continue;
    std::vector<PolygonPart> parts;
    if (!file.geos().parts(geometry.get(), parts)) file.fail(row, "is not a polygon; leave it out");
    if (!parts.empty()) groups.push_back(std::move(parts));
  }
  if (groups.empty()) fail_file(name, fmt::format("layer {} holds no polygon", layer.table));
  if (crs != nullptr) crs->name = layer.crs;
  return unite(groups, name);
}

}  // namespace powercell::io
