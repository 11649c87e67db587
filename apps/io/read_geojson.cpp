// GeoJSON (RFC 7946). GEOS reads it too, but its messages name neither object nor line. The JSON library's
// do, and there are few kinds of geometry.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/io/read_file.hpp"
#include "apps/io/read_polygons.hpp"

namespace powercell::io {
namespace {

using nlohmann::json;

constexpr int deepest_nesting = 32;  // of GeometryCollections in one another

class GeoJson {
 public:
  explicit GeoJson(const std::string& name) : name_(name) {}

  void object(const json& value, const std::string& path, int depth) {
    if (depth > deepest_nesting) fail(path, "is nested too deeply");
    if (!value.is_object() || !value.contains("type") || !value["type"].is_string()) {
      fail(path, "is not a GeoJSON object (an object with a type)");
    }
    const std::string type = value["type"];
    if (type == "FeatureCollection") {
      members(value, "features", path, depth);
    } else if (type == "GeometryCollection") {
      members(value, "geometries", path, depth);
    } else if (type == "Feature") {
      if (!value.contains("geometry")) fail(path, "has no geometry");
      if (!value["geometry"].is_null()) object(value["geometry"], path + ".geometry", depth + 1);
    } else if (type == "Polygon") {
      const json& rings = coordinates(value, path);  // an empty array means null (RFC 7946, 3.1)
      if (!rings.empty()) groups.push_back({part(rings, path + ".coordinates")});
    } else if (type == "MultiPolygon") {
      const json& all = coordinates(value, path);
      std::vector<PolygonPart> group;
      for (std::size_t k = 0; k < all.size(); ++k)
        group.push_back(part(all[k], fmt::format("{}.coordinates[{}]", path, k)));
      if (!group.empty()) groups.push_back(std::move(group));
    } else {
      fail(path, fmt::format("is a {}; only Polygon and MultiPolygon make a domain: leave the others out",
                             type.substr(0, 40)));
    }
  }

  std::vector<std::vector<PolygonPart>> groups;  // one a geometry

 private:
  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    fail_file(name_, fmt::format("{} {}", path, what));
  }

  void members(const json& value, const char* key, const std::string& path, int depth) {
    if (!value.contains(key) || !value[key].is_array()) fail(path, fmt::format("has no array {}", key));
    for (std::size_t k = 0; k < value[key].size(); ++k)
      object(value[key][k], fmt::format("{}.{}[{}]", path, key, k), depth + 1);
  }

  const json& coordinates(const json& value, const std::string& path) const {
    if (!value.contains("coordinates") || !value["coordinates"].is_array())
      fail(path, "has no array coordinates");
    return value["coordinates"];
  }

  PolygonPart part(const json& rings, const std::string& path) const {
    if (!rings.is_array() || rings.empty()) fail(path, "is not a polygon (an array of rings)");
    PolygonPart result;
    for (std::size_t k = 0; k < rings.size(); ++k) {
      Ring r = ring(rings[k], fmt::format("{}[{}]", path, k));
      k == 0 ? result.outer = std::move(r) : result.holes.emplace_back(std::move(r));
    }
    return result;
  }

  Ring ring(const json& points, const std::string& path) const {
    if (!points.is_array() || points.size() < 4)
      fail(path, "is not a ring (an array of at least 4 points, the last equal to the first)");
    Ring result;
    result.reserve(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const json& p = points[k];
      if (!p.is_array() || p.size() < 2 || !p[0].is_number() || !p[1].is_number()) {
        fail(fmt::format("{}[{}]", path, k), "is not a point (an array of at least 2 numbers)");
      }
      result.push_back({p[0].get<double>(), p[1].get<double>()});
    }
    if (result.front() != result.back()) fail(path, "is not closed: its last point differs from its first");
    result.pop_back();
    return result;
  }

  std::string name_;
};

/// GeoJSON of 2008 names its system in a member; RFC 7946 did away with it, but programs write it where the
/// coordinates are not longitude and latitude.
NamedCrs crs_of(const json& document) {
  NamedCrs crs;
  if (!document.is_object() || !document.contains("crs")) return crs;
  const json& member = document["crs"];
  crs.member = member.dump(-1, ' ', false, json::error_handler_t::replace);
  if (!member.is_object() || member.value("type", json()) != "name") return crs;
  const json name = member.value("properties", json::object()).value("name", json());
  if (name.is_string()) crs.name = name.get<std::string>();
  return crs;
}

}  // namespace

std::vector<PolygonPart> parse_geojson(std::string_view text, const std::string& name, NamedCrs* crs) {
  json document;
  try {
    document = json::parse(text);
  } catch (const json::exception& error) {
    std::string what = error.what();
    const std::size_t line = what.find("at line ");
    what = what.substr(what.find(']') == std::string::npos ? 0 : what.find(']') + 2);
    if (line == std::string::npos) fail_file(name, fmt::format("is not JSON: {}", what));
    const std::size_t number = std::strtoul(error.what() + line + 8, nullptr, 10);
    fail_line(name, number, fmt::format("is not JSON, or truncated: {}", what));
  }
  GeoJson reader(name);
  reader.object(document, "$", 0);
  if (reader.groups.empty()) fail_file(name, "holds no polygon");
  if (crs != nullptr) *crs = crs_of(document);
  return unite(reader.groups, name);
}

}  // namespace powercell::io
