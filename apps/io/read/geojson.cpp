// GeoJSON (RFC 7946). GEOS reads it too, but its messages name neither object nor line. The JSON library's
// do, and there are few kinds of geometry.
#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/io/read/file.hpp"
#include "apps/io/read/polygons.hpp"
#include "apps/io/tables/feature_rows.hpp"

namespace powercell::io {
namespace {

using OrderedJson = nlohmann::ordered_json;  // attributes in the order of the file

constexpr int deepest_collections = 32;  // of GeometryCollections in one another

/// Walks through a document; what is done with its geometries is of the derived class.
class GeoJson {
 public:
  explicit GeoJson(const std::string& name) : name_(name) {}
  virtual ~GeoJson() = default;

  void object(const OrderedJson& value, const std::string& path, int depth,
              const OrderedJson* feature = nullptr) {
    if (depth > deepest_collections) fail(path, "is nested too deeply");
    if (!value.is_object() || !value.contains("type") || !value["type"].is_string())
      fail(path, "is not a GeoJSON object (an object with a type)");
    const std::string type = value["type"];
    if (type == "Topology")
      fail(path, "is TopoJSON, which is not read; GDAL converts it: ogr2ogr -f GeoJSON map.geojson " + name_);
    if (type == "FeatureCollection") {
      members(value, "features", path, depth, nullptr);
    } else if (type == "GeometryCollection") {
      members(value, "geometries", path, depth, feature);
    } else if (type == "Feature") {
      if (!value.contains("geometry")) fail(path, "has no geometry");
      if (value["geometry"].is_null())
        no_geometry(path);
      else
        object(value["geometry"], path + ".geometry", depth + 1, &value);
    } else {
      geometry(value, type, path, feature);
    }
  }

 protected:
  virtual void geometry(const OrderedJson& value, const std::string& type, const std::string& path,
                        const OrderedJson* feature) = 0;
  virtual void no_geometry(const std::string&) {}

  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    fail_file(name_, fmt::format("{} {}", path, what));
  }

  const OrderedJson& coordinates(const OrderedJson& value, const std::string& path) const {
    if (!value.contains("coordinates") || !value["coordinates"].is_array())
      fail(path, "has no array coordinates");
    return value["coordinates"];
  }

  /// The numbers of a point: 2, or 3 and more.
  std::vector<double> point(const OrderedJson& p, const std::string& path) const {
    if (!p.is_array() || p.size() < 2) fail(path, "is not a point (an array of at least 2 numbers)");
    std::vector<double> numbers;
    for (const OrderedJson& number : p) {
      if (!number.is_number()) fail(path, "is not a point (an array of at least 2 numbers)");
      numbers.push_back(number.get<double>());
    }
    return numbers;
  }

 private:
  void members(const OrderedJson& value, const char* key, const std::string& path, int depth,
               const OrderedJson* feature) {
    if (!value.contains(key) || !value[key].is_array()) fail(path, fmt::format("has no array {}", key));
    for (std::size_t k = 0; k < value[key].size(); ++k)
      object(value[key][k], fmt::format("{}.{}[{}]", path, key, k), depth + 1, feature);
  }

  std::string name_;
};

class GeoJsonPolygons : public GeoJson {
 public:
  using GeoJson::GeoJson;
  std::vector<std::vector<PolygonPart>> groups;  // one a geometry

 private:
  void geometry(const OrderedJson& value, const std::string& type, const std::string& path,
                const OrderedJson*) override {
    if (type == "Polygon") {
      const OrderedJson& rings = coordinates(value, path);  // an empty array means null (RFC 7946, 3.1)
      if (!rings.empty()) groups.push_back({part(rings, path + ".coordinates")});
    } else if (type == "MultiPolygon") {
      const OrderedJson& all = coordinates(value, path);
      std::vector<PolygonPart> group;
      for (std::size_t k = 0; k < all.size(); ++k)
        group.push_back(part(all[k], fmt::format("{}.coordinates[{}]", path, k)));
      if (!group.empty()) groups.push_back(std::move(group));
    } else {
      fail(path, fmt::format("is a {}; only Polygon and MultiPolygon make a domain: leave the others out",
                             type.substr(0, 40)));
    }
  }

  PolygonPart part(const OrderedJson& rings, const std::string& path) const {
    if (!rings.is_array() || rings.empty()) fail(path, "is not a polygon (an array of rings)");
    PolygonPart result;
    for (std::size_t k = 0; k < rings.size(); ++k) {
      Ring r = ring(rings[k], fmt::format("{}[{}]", path, k));
      k == 0 ? result.outer = std::move(r) : result.holes.emplace_back(std::move(r));
    }
    return result;
  }

  Ring ring(const OrderedJson& points, const std::string& path) const {
    if (!points.is_array() || points.size() < 4)
      fail(path, "is not a ring (an array of at least 4 points, the last equal to the first)");
    Ring result;
    result.reserve(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::vector<double> p = point(points[k], fmt::format("{}[{}]", path, k));
      result.push_back({p[0], p[1]});
    }
    if (result.front() != result.back()) fail(path, "is not closed: its last point differs from its first");
    result.pop_back();
    return result;
  }
};

class GeoJsonPoints : public GeoJson {
 public:
  struct Feature {
    std::array<double, 3> point;
    std::map<std::string, std::string> attributes;
  };

  using GeoJson::GeoJson;
  std::vector<Feature> features;
  std::vector<std::string> attributes;  // their names, in the order in which they appear

 private:
  void geometry(const OrderedJson& value, const std::string& type, const std::string& path,
                const OrderedJson* feature) override {
    const OrderedJson* numbers = &coordinates(value, path);
    if (type == "MultiPoint" && numbers->size() == 1)
      numbers = &(*numbers)[0];
    else if (type == "MultiPoint")
      fail(path, fmt::format("has {} points; split it into features of one point", numbers->size()));
    else if (type != "Point")
      fail(path, fmt::format("is a {}; seeds are points", type.substr(0, 40)));
    const std::vector<double> p = point(*numbers, path + ".coordinates");
    features.push_back({{p[0], p[1], p.size() > 2 ? p[2] : std::numeric_limits<double>::quiet_NaN()}, {}});
    if (feature == nullptr) return;
    if (feature->contains("id")) add("id", (*feature)["id"]);
    if (!feature->contains("properties") || !(*feature)["properties"].is_object()) return;
    for (const auto& [key, property] : (*feature)["properties"].items()) add(key, property);
  }
  void no_geometry(const std::string& path) override {
    fail(path, "has no point; remove it, or give it one");
  }

  void add(const std::string& key, const OrderedJson& value) {
    if (known_.insert(key).second) attributes.push_back(key);
    features.back().attributes[key] = value.is_null() ? ""
                                      : value.is_string()
                                          ? value.get<std::string>()
                                          : value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  }

  std::set<std::string> known_;
};

/// GeoJSON of 2008 names its system in a member; RFC 7946 did away with it, but programs write it where the
/// coordinates are not longitude and latitude.
NamedCrs crs_of(const OrderedJson& document) {
  NamedCrs crs;
  if (!document.is_object() || !document.contains("crs")) return crs;
  const OrderedJson& member = document["crs"];
  crs.member = member.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  if (!member.is_object() || member.value("type", OrderedJson()) != "name") return crs;
  const OrderedJson name = member.value("properties", OrderedJson::object()).value("name", OrderedJson());
  if (name.is_string()) crs.name = name.get<std::string>();
  return crs;
}

OrderedJson parse_json(std::string_view text, const std::string& name) {
  try {
    return OrderedJson::parse(text);
  } catch (const OrderedJson::exception& error) {
    std::string what = error.what();
    const std::size_t line = what.find("at line ");
    what = what.substr(what.find(']') == std::string::npos ? 0 : what.find(']') + 2);
    if (line == std::string::npos) fail_file(name, fmt::format("is not JSON: {}", what));
    const std::size_t number = std::strtoul(error.what() + line + 8, nullptr, 10);
    fail_line(name, number, fmt::format("is not JSON, or truncated: {}", what));
  }
}

}  // namespace

FeatureRows parse_geojson_points(std::string_view text, std::size_t dimension, const std::string& name) {
  const OrderedJson document = parse_json(text, name);
  GeoJsonPoints reader(name);
  reader.object(document, "$", 0);
  FeatureRows rows(name, dimension, reader.attributes);
  std::vector<std::string> values(reader.attributes.size());
  for (const GeoJsonPoints::Feature& feature : reader.features) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto found = feature.attributes.find(reader.attributes[k]);
      values[k] = found == feature.attributes.end() ? "" : found->second;
    }
    rows.add(feature.point, values);
  }
  rows.crs = crs_of(document);
  return rows;
}

std::vector<PolygonPart> parse_geojson(std::string_view text, const std::string& name, NamedCrs* crs) {
  const OrderedJson document = parse_json(text, name);
  GeoJsonPolygons reader(name);
  reader.object(document, "$", 0);
  if (reader.groups.empty()) fail_file(name, "holds no polygon");
  if (crs != nullptr) *crs = crs_of(document);
  return unite(reader.groups, name);
}

}  // namespace powercell::io
