#include "apps/io/maps/crs.hpp"

#include <fmt/format.h>
#include <proj.h>

#include <cmath>
#include <powercell/error.hpp>

#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

struct DestroyContext {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct Destroy {
  void operator()(PJ* object) const { proj_destroy(object); }
};
using Object = std::unique_ptr<PJ, Destroy>;

/// One for the process: creating one opens PROJ's database.
PJ_CONTEXT* context() {
  static const std::unique_ptr<PJ_CONTEXT, DestroyContext> one = [] {
    std::unique_ptr<PJ_CONTEXT, DestroyContext> made(proj_context_create());
    proj_log_level(made.get(), PJ_LOG_NONE);
    proj_context_set_enable_network(made.get(), 0);
    return made;
  }();
  return one.get();
}

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorCode::invalid_argument, what);
}

std::string reason() {
  const int code = proj_context_errno(context());
  const char* text = code != 0 ? proj_context_errno_string(context(), code) : nullptr;
  return text != nullptr ? fmt::format(" ({})", readable(text)) : "";
}

/// The system of a name, of two dimensions: the horizontal part of a compound one.
Object create(const std::string& name) {
  Object object(proj_create(context(), name.c_str()));
  if (!object && proj_context_get_database_path(context()) == nullptr)
    fail(
        "PROJ does not find its database proj.db; install the package proj-data, or set PROJ_DATA to its "
        "folder");
  if (!object)
    fail(fmt::format(
        "PROJ does not know the coordinate system '{}'; give one such as EPSG:4326 (degrees) or EPSG:32633",
        readable(name)));
  if (proj_get_type(object.get()) == PJ_TYPE_COMPOUND_CRS)
    object.reset(proj_crs_get_sub_crs(context(), object.get(), 0));
  if (object && proj_get_type(object.get()) == PJ_TYPE_BOUND_CRS)
    object.reset(proj_get_source_crs(context(), object.get()));
  if (!object) fail(fmt::format("the coordinate system '{}' has no horizontal part", readable(name)));
  return object;
}

/// The longitudes and latitudes under a system.
Object degrees_under(const PJ* crs) {
  return Object(proj_crs_get_geodetic_crs(context(), crs));
}

Ellipsoid ellipsoid_of(const PJ* crs) {
  Ellipsoid ellipsoid;
  const Object object(proj_get_ellipsoid(context(), crs));
  if (object)
    proj_ellipsoid_get_parameters(context(), object.get(), &ellipsoid.a, nullptr, nullptr,
                                  &ellipsoid.inverse_flattening);
  return ellipsoid;
}

/// Name of the unit of the first axis, and how many radians or metres it is.
std::pair<std::string, double> unit_of(const PJ* crs) {
  const Object system(proj_crs_get_coordinate_system(context(), crs));
  const char* name = nullptr;
  double factor = 0;
  if (!system || proj_cs_get_axis_info(context(), system.get(), 0, nullptr, nullptr, nullptr, &factor, &name,
                                       nullptr, nullptr) == 0)
    return {};
  return {name, factor};
}

class Transformation final : public PointMap {
 public:
  Transformation(Object transformation) : transformation_(std::move(transformation)) {}
  MapPoint forward(MapPoint point) const override { return apply(PJ_FWD, point); }
  MapPoint inverse(MapPoint point) const override { return apply(PJ_INV, point); }

 private:
  MapPoint apply(PJ_DIRECTION direction, MapPoint point) const {
    proj_errno_reset(transformation_.get());
    const PJ_COORD to = proj_trans(transformation_.get(), direction, proj_coord(point[0], point[1], 0, 0));
    if (!std::isfinite(to.v[0]) || !std::isfinite(to.v[1]))
      fail(fmt::format("the point ({:.10g}, {:.10g}) lies outside of what its coordinate system covers",
                       point[0], point[1]));
    return {to.v[0], to.v[1]};
  }
  Object transformation_;
};

class Identity final : public PointMap {
 public:
  MapPoint forward(MapPoint point) const override { return point; }
  MapPoint inverse(MapPoint point) const override { return point; }
};

/// Lambert's projection about a centre; degrees in, metres out.
class Lambert final : public PointMap {
 public:
  Lambert(Object projection, double longitude) : projection_(std::move(projection)), longitude_(longitude) {}

  MapPoint forward(MapPoint degrees) const override {
    const PJ_COORD from = proj_coord(proj_torad(degrees[0] - longitude_), proj_torad(degrees[1]), 0, 0);
    proj_errno_reset(projection_.get());
    const PJ_COORD to = proj_trans(projection_.get(), PJ_FWD, from);
    if (!std::isfinite(to.v[0]) || !std::isfinite(to.v[1]))
      fail(
          fmt::format("the point ({:.10g}, {:.10g}) cannot be projected; longitudes and latitudes are meant "
                      "to be in degrees, the longitude first",
                      degrees[0], degrees[1]));
    return {to.v[0], to.v[1]};
  }
  MapPoint inverse(MapPoint plane) const override {
    // PROJ's series for the latitude is right to half a millimetre. The forward formula is exact, so a second
    // step from its residual is right to rounding.
    const MapPoint rough = forward(unprojected(plane));
    return unprojected({2 * plane[0] - rough[0], 2 * plane[1] - rough[1]});
  }

 private:
  MapPoint unprojected(MapPoint plane) const {
    proj_errno_reset(projection_.get());
    const PJ_COORD to = proj_trans(projection_.get(), PJ_INV, proj_coord(plane[0], plane[1], 0, 0));
    return {longitude_ + proj_todeg(to.v[0]), proj_todeg(to.v[1])};
  }

  Object projection_;
  double longitude_;
};

std::string ellipsoid_text(const Ellipsoid& ellipsoid) {
  if (ellipsoid.inverse_flattening == 0) return fmt::format("+R={}", ellipsoid.a);
  return fmt::format("+a={} +rf={}", ellipsoid.a, ellipsoid.inverse_flattening);
}

}  // namespace

Crs describe_crs(const std::string& name) {
  const Object crs = create(name);
  Crs result;
  result.name = name;
  result.title = proj_get_name(crs.get());
  result.ellipsoid = ellipsoid_of(crs.get());
  const auto [unit, factor] = unit_of(crs.get());
  result.unit = unit;
  result.metres = factor;
  const PJ_TYPE type = proj_get_type(crs.get());
  result.geographic = type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
  if ((!result.geographic && type != PJ_TYPE_PROJECTED_CRS) || !(result.ellipsoid.a > 0))
    fail(fmt::format("the coordinate system '{}' ({}) is not one of maps, in degrees or lengths",
                     readable(name), readable(result.title)));
  if (result.geographic && std::abs(factor - proj_torad(1)) > 1e-9)
    fail(fmt::format("the coordinate system '{}' ({}) is in units of '{}'; give the coordinates in degrees",
                     readable(name), readable(result.title), unit));
  return result;
}

bool is_in_degrees(const std::string& name) {
  if (name.empty()) return false;
  try {
    return describe_crs(name).geographic;
  } catch (const Error&) {
    return name.ends_with(":4326") || name.ends_with("CRS84");
  }
}

bool is_same_crs(const std::string& a, const std::string& b) {
  return a == b || proj_is_equivalent_to(create(a).get(), create(b).get(),
                                         PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) != 0;
}

std::unique_ptr<PointMap> map_between(const std::string& from, const std::string& to) {
  const Object source = create(from), target = create(to);
  Object between(proj_create_crs_to_crs_from_pj(context(), source.get(), target.get(), nullptr, nullptr));
  if (between) between.reset(proj_normalize_for_visualization(context(), between.get()));
  if (!between)
    fail(fmt::format("PROJ has no transformation from '{}' to '{}'{}", readable(from), readable(to),
                     reason()));
  return std::make_unique<Transformation>(std::move(between));
}

std::unique_ptr<PointMap> map_to_degrees(const Crs& crs) {
  if (crs.geographic) return std::make_unique<Identity>();
  const Object source = create(crs.name), target = degrees_under(source.get());
  Object between(proj_create_crs_to_crs_from_pj(context(), source.get(), target.get(), nullptr, nullptr));
  if (between) between.reset(proj_normalize_for_visualization(context(), between.get()));
  if (!between) fail(fmt::format("PROJ has no longitudes and latitudes for '{}'", readable(crs.name)));
  return std::make_unique<Transformation>(std::move(between));
}

EqualArea equal_area(const Ellipsoid& ellipsoid, MapPoint centre) {
  const std::string shape = ellipsoid_text(ellipsoid);
  Object projection(
      proj_create(context(), fmt::format("+proj=laea +lat_0={} +lon_0=0 {}", centre[1], shape).c_str()));
  if (!projection) fail(fmt::format("PROJ cannot make an equal-area projection{}", reason()));
  return {std::make_unique<Lambert>(std::move(projection), centre[0]),
          fmt::format("+proj=laea +lat_0={} +lon_0={} {} +units=m +type=crs", centre[1], centre[0], shape)};
}

}  // namespace powercell::io
