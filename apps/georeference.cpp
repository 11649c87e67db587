#include "apps/georeference.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <powercell/error.hpp>

#include "apps/io/printable.hpp"
#include "apps/io/read/domain.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/tables/seeds_outside.hpp"

namespace powercell::app {
namespace {

constexpr const char* degrees_crs = "OGC:CRS84";  // longitude, latitude on WGS 84

template <class Function>
void for_each_point(const io::DomainArrays& domain, const Function& function) {
  for (const PolygonPart& part : domain.parts) {
    for (const auto& point : part.outer) function(point);
    for (const Ring& hole : part.holes)
      for (const auto& point : hole) function(point);
  }
}

bool may_be_degrees(const io::DomainArrays& domain) {
  bool all = true;
  for_each_point(domain, [&](const io::MapPoint& p) {
    all = all && p[0] >= -180 && p[0] <= 360 && std::abs(p[1]) <= 90;
  });
  return all;
}

/// Whether a note is due. GeoJSON is in degrees unless agreed otherwise (RFC 7946); numbers of other files
/// look like degrees if they are not whole.
bool look_like_degrees(const io::DomainArrays& domain, const std::string& file) {
  if (!may_be_degrees(domain)) return false;
  const std::string extension = io::lower_extension(file);
  if (extension == ".geojson" || extension == ".json") return true;
  bool whole = true;
  double nearest = 360;
  for_each_point(domain, [&](const io::MapPoint& p) {
    whole = whole && p[0] == std::round(p[0]) && p[1] == std::round(p[1]);
    nearest = std::min(nearest, std::hypot(p[0], p[1]));
  });
  return !whole && nearest > 1;
}

/// The member `crs` of GeoJSON for a system; longitude and latitude on WGS 84 need none.
std::string crs_member(const std::string& name) {
  if (io::is_same_crs(name, degrees_crs)) return {};
  std::string urn = name;
  if (name.size() > 5 && (name.starts_with("EPSG:") || name.starts_with("epsg:")) &&
      std::all_of(name.begin() + 5, name.end(), [](char c) { return c >= '0' && c <= '9'; }))
    urn = "urn:ogc:def:crs:EPSG::" + name.substr(5);
  return nlohmann::json({{"type", "name"}, {"properties", {{"name", urn}}}})
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string titled(const io::Crs& crs) {
  const std::string name = io::readable(crs.name), title = io::readable(crs.title);
  return crs.title.empty() || crs.title == "unknown" || name == title ? name
                                                                      : fmt::format("{} ({})", name, title);
}

/// The system of that name; none if it is empty or not known.
std::optional<io::Crs> find_crs(const std::string& name) {
  if (name.empty()) return std::nullopt;
  try {
    return io::describe_crs(name);
  } catch (const Error&) {
    return std::nullopt;
  }
}

class Placing {
 public:
  Placing(const MapArguments& arguments, const std::string& file, const io::DomainArrays& domain,
          const io::SeedColumns& columns)
      : arguments_(arguments), file_(file), domain_(domain), columns_(columns) {}

  Georeference place() {
    if (!is_map()) return std::move(result_);
    const std::string name = domain_crs();
    if (name.empty()) return std::move(result_);
    const io::Crs crs = io::describe_crs(name);
    result_.frame.crs = name;
    result_.frame.member =
        arguments_.crs.empty() && !domain_.crs.member.empty() ? domain_.crs.member : crs_member(name);
    place_seeds(crs);
    if (crs.geographic ? !arguments_.no_project : arguments_.project)
      project(crs);
    else
      stay(crs);
    return std::move(result_);
  }

 private:
  [[noreturn]] static void fail(const std::string& what) { throw Error(ErrorCode::invalid_argument, what); }
  void note(std::string text) { result_.notes.push_back("map: " + std::move(text)); }

  bool is_map() const {
    const bool polygons = domain_.kind == DomainKind::polygon && !io::is_builtin_domain(file_) &&
                          io::lower_extension(file_) != ".svg";
    if (!polygons && (!(arguments_.crs + arguments_.seeds_crs).empty() || arguments_.project))
      fail(file_ +
           ": --crs, --seeds-crs and --project are for polygons of maps, from GeoJSON, GeoPackage, WKT or "
           "text");
    return polygons;
  }

  std::string degree_columns() const {
    return fmt::format("'{}' and '{}'", io::readable(columns_.names[columns_.position[0]]),
                       io::readable(columns_.names[columns_.position[1]]));
  }

  [[noreturn]] void fail_without_degrees() const {
    io::MapPoint point{};
    for_each_point(domain_, [&](const io::MapPoint& p) {
      if (p[0] < -180 || p[0] > 360 || std::abs(p[1]) > 90) point = p;
    });
    fail(
        fmt::format("{}: has the point ({:.6g}, {:.6g}), which is not in degrees, but the seeds' columns {} "
                    "are: name its coordinate system with --crs, or take all numbers as they are with "
                    "--no-project",
                    file_, point[0], point[1], degree_columns()));
  }

  /// Name of the domain's system; empty if its coordinates are just a plane.
  std::string domain_crs() {
    if (!arguments_.crs.empty()) {
      if (!domain_.crs.name.empty() && domain_.crs.name != arguments_.crs)
        source_ = fmt::format(", by --crs (the file says {})", io::readable(domain_.crs.name));
      return arguments_.crs;
    }
    if (!domain_.crs.name.empty()) return file_crs();
    if (columns_.degrees && may_be_degrees(domain_)) {
      source_ = fmt::format(", as the columns {} say", degree_columns());
      return degrees_crs;
    }
    if (columns_.degrees && !arguments_.no_project) fail_without_degrees();
    if (const auto crs = find_crs(columns_.crs); crs && (may_be_degrees(domain_) || !crs->geographic)) {
      source_ = ", as the file of the seeds says";
      return columns_.crs;
    }
    if (!columns_.crs.empty())
      note(fmt::format("the seeds' file is in {}, which is not used, as nothing names the domain's system",
                       io::readable(columns_.crs)));
    if (!arguments_.seeds_crs.empty() || arguments_.project)
      fail(file_ + ": nothing names its coordinate system; give --crs, for degrees --crs EPSG:4326");
    if (look_like_degrees(domain_, file_) && !arguments_.no_project)
      note(
          "the coordinates may be degrees, but nothing says so: computed as a plane, areas in squares of "
          "their unit (--crs EPSG:4326 if they are degrees, --no-project if not)");
    return {};
  }

  std::string file_crs() {
    source_ = ", as the file says";
    try {
      io::describe_crs(domain_.crs.name);
      return domain_.crs.name;
    } catch (const Error& error) {
      if (arguments_.project || !arguments_.seeds_crs.empty()) throw;
      result_.frame.member = domain_.crs.member;
      note(fmt::format("{}: computed as a plane", error.what()));
      return {};
    }
  }

  void place_seeds(const io::Crs& crs) {
    std::string name = arguments_.seeds_crs;
    std::string source;
    if (name.empty() && find_crs(columns_.crs)) {
      name = columns_.crs;
      source = ", as their file says";
    } else if (name.empty() && !columns_.crs.empty()) {
      note(fmt::format("the seeds' file is in {}, which is not known: taken as the domain's {}",
                       io::readable(columns_.crs), io::readable(crs.name)));
    }
    if (name.empty() && columns_.degrees && !crs.geographic) {
      name = degrees_crs;
      source = fmt::format(", as the columns {} say", degree_columns());
    }
    if (name.empty() || io::is_same_crs(name, crs.name)) return;
    result_.seeds = io::map_between(name, crs.name);
    note(fmt::format("seeds are in {}{}, and were transformed to the domain's {}", io::readable(name), source,
                     io::readable(crs.name)));
  }

  void project(const io::Crs& crs) {
    std::shared_ptr<const io::MapPlane> plane;
    try {
      plane = std::make_shared<io::MapPlane>(crs, domain_.parts);
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}: {} (--no-project computes in the plane of the coordinates)",
                                            file_, error.what()));
    }
    note(fmt::format("{}{}; projected to the equal-area plane {}, distances right to {:.2g} %", titled(crs),
                     source_, plane->definition(), 100 * plane->distortion()));
    note(
        fmt::format("areas and weights are in m2; coordinates in tables and GeoJSON are in {}, in pictures "
                    "and other files in metres of the plane",
                    io::readable(crs.name)));
    result_.frame.plane = std::move(plane);
  }

  void stay(const io::Crs& crs) {
    if (crs.geographic) {
      note(fmt::format("{}{}; computed as a plane of degrees: areas and weights are in square degrees",
                       titled(crs), source_));
      return;
    }
    const auto [least, largest] = scale(crs);
    std::string size;
    if (largest > 0 && std::max(std::abs(least - 1), std::abs(largest - 1)) < 1e-6)
      size = ", which keeps areas";
    else if (largest > 0)
      size =
          fmt::format(", {:.5g} to {:.5g} times those on the ground (--project for those)", least, largest);
    note(fmt::format("{}{}; areas and weights are of its plane (unit: {}){}", titled(crs), source_, crs.unit,
                     size));
  }

  /// The areal scale at the vertices and on a grid over their box.
  std::array<double, 2> scale(const io::Crs& crs) const {
    constexpr int most = 10;
    const auto to_degrees = io::map_to_degrees(crs);
    std::array<double, 2> range = {std::numeric_limits<double>::infinity(), 0};
    const auto add = [&](const io::MapPoint& point) {
      const double scale = io::areal_scale(crs, *to_degrees, point);
      if (!std::isfinite(scale)) return;
      range = {std::min(range[0], scale), std::max(range[1], scale)};
    };
    for_each_point(domain_, add);
    const io::SeedBox box = io::seed_box(domain_.parts);
    for (int i = 0; i <= most; ++i)
      for (int j = 0; j <= most; ++j)
        add({box.low[0] + (box.high[0] - box.low[0]) * i / most,
             box.low[1] + (box.high[1] - box.low[1]) * j / most});
    return range;
  }

  const MapArguments& arguments_;
  const std::string& file_;
  const io::DomainArrays& domain_;
  const io::SeedColumns& columns_;
  std::string source_;
  Georeference result_;
};

}  // namespace

void add_map_options(CLI::App& command, MapArguments& arguments) {
  const auto group = "Maps";
  command
      .add_option("--crs", arguments.crs,
                  "Coordinate system of a polygon's file, such as EPSG:4326 (degrees) or EPSG:32633")
      ->default_str("what the file says; degrees if the seeds' columns are named lon and lat")
      ->type_name("CRS")
      ->group(group);
  command.add_option("--seeds-crs", arguments.seeds_crs, "That of the seeds")
      ->default_str("what their file says; degrees if their columns are named lon and lat; else the domain's")
      ->type_name("CRS")
      ->group(group);
  auto* project = command.add_flag("--project", arguments.project,
                                   "Compute in an equal-area plane, which is the default for degrees only");
  auto* stay = command.add_flag("--no-project", arguments.no_project,
                                "Compute in the plane of the coordinates, degrees too");
  project->group(group)->excludes(stay);
  stay->group(group);
}

Georeference georeference(const MapArguments& arguments, const std::string& file,
                          const io::DomainArrays& domain, const io::SeedColumns& columns) {
  return Placing(arguments, file, domain, columns).place();
}

}  // namespace powercell::app
