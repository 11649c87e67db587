#include <doctest/doctest.h>

#include <cmath>
#include <powercell/error.hpp>
#include <vector>

#include "apps/io/maps/crs.hpp"
#include "apps/io/maps/projection.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

namespace {

const double radian = std::acos(-1.0) / 180;

/// Area between two meridians and two parallels in closed form (Snyder 1987, (3-11) and (3-12)).
double box_area(const Ellipsoid& shape, double west, double south, double east, double north) {
  const double f = shape.inverse_flattening == 0 ? 0 : 1 / shape.inverse_flattening,
               e = std::sqrt(f * (2 - f));
  const auto q = [e](double latitude) {
    const double s = std::sin(latitude * radian);
    if (e == 0) return 2 * s;
    return (1 - e * e) * (s / (1 - e * e * s * s) - std::log((1 - e * s) / (1 + e * s)) / (2 * e));
  };
  return shape.a * shape.a * (east - west) * radian * (q(north) - q(south)) / 2;
}

PolygonPart box(double west, double south, double east, double north) {
  return {{{west, south}, {east, south}, {east, north}, {west, north}}, {}};
}

struct BoxCase {
  const char* crs;
  double west, south, east, north;
};

}  // namespace

TEST_CASE("boxes of longitude and latitude have their areas") {
  for (const BoxCase& c : {BoxCase{"EPSG:4326", 6, 45, 16, 55}, BoxCase{"EPSG:4326", -80, -30, -40, 12},
                           BoxCase{"EPSG:4326", 11.25, 48.125, 11.2515, 48.126},
                           BoxCase{"OGC:CRS84", 20, 69, 32, 71.5}, BoxCase{"EPSG:4269", -125, 24, -66, 49},
                           BoxCase{"EPSG:4277", -6, 50, 2, 59}, BoxCase{"EPSG:4326", 177, -19, 183, -16},
                           BoxCase{"+proj=longlat +R=6371000 +type=crs", 0, 40, 30, 60}}) {
    CAPTURE(c.crs);
    CAPTURE(c.west);
    const Crs crs = describe_crs(c.crs);
    CHECK(crs.geographic);
    const MapPlane plane(crs, {box(c.west, c.south, c.east, c.north)});
    const double expected = box_area(crs.ellipsoid, c.west, c.south, c.east, c.north);
    CHECK(area(plane.parts()) == doctest::Approx(expected).epsilon(1e-7));
    CHECK(ring_area(crs.ellipsoid, plane.map_parts()[0].outer) == doctest::Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("a hole takes its area away") {
  const Crs crs = describe_crs("EPSG:4326");
  PolygonPart part = box(6, 45, 16, 55);
  part.holes.push_back(box(8, 47, 9, 52).outer);
  const MapPlane plane(crs, {part});
  CHECK(area(plane.parts()) ==
        doctest::Approx(box_area(crs.ellipsoid, 6, 45, 16, 55) - box_area(crs.ellipsoid, 8, 47, 9, 52))
            .epsilon(1e-7));
}

TEST_CASE("parts that are cut at 180 degrees meet in the plane") {
  const Crs crs = describe_crs("EPSG:4326");
  const MapPlane plane(crs, {box(177, -19, 180, -16), box(-180, -19, -178, -16)});
  CHECK(plane.parts().size() == 1);
  CHECK(plane.middle() == MapPoint{179.5, -17.5});
  CHECK(area(plane.parts()) == doctest::Approx(box_area(crs.ellipsoid, 177, -19, 182, -16)).epsilon(1e-7));
  const MapPoint west = plane.to_plane({-179, -17}), east = plane.to_plane({181, -17});
  CHECK(std::hypot(west[0] - east[0], west[1] - east[1]) < 1e-8);
}

TEST_CASE("polygons about a pole or the globe are refused") {
  const Crs crs = describe_crs("EPSG:4326");
  for (const PolygonPart& part : {box(-180, -90, 180, -70), box(-180, -60, 180, 60), box(-170, 0, 175, 10)}) {
    CHECK(says(refusal([&] { MapPlane(crs, {part}); }), "reach around a pole or the globe"));
  }
}

TEST_CASE("points go to the plane and come back") {
  for (const char* name : {"EPSG:4326", "EPSG:32633"}) {
    const Crs crs = describe_crs(name);
    const PolygonPart part = crs.geographic ? box(6, 45, 16, 55) : box(3e5, 5e6, 7e5, 5.5e6);
    const MapPlane plane(crs, {part});
    const double step = crs.geographic ? 1 : 4e4;
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; j <= 10; ++j) {
        const MapPoint p = {part.outer[0][0] + step * i, part.outer[0][1] + step * j};
        const MapPoint back = plane.to_map(plane.to_plane(p));
        CHECK(std::hypot(back[0] - p[0], back[1] - p[1]) < 1e-12 * std::hypot(p[0], p[1]));
        CHECK(plane.rounded(back) == p);
      }
  }
}

TEST_CASE("a segment of the plane is traced on the map alike from both ends") {
  const Crs crs = describe_crs("EPSG:4326");
  const MapPlane plane(crs, {box(6, 45, 16, 55)});
  const MapPoint a = plane.to_plane({7, 46}), b = plane.to_plane({15, 52});
  std::vector<MapPoint> forth, back;
  plane.trace_to_map(a, b, forth);
  plane.trace_to_map(b, a, back);
  REQUIRE(forth.size() == back.size());
  CHECK(forth.size() > 10);
  CHECK(forth.back() == MapPoint{15, 52});
  CHECK(back.back() == MapPoint{7, 46});
  for (std::size_t k = 0; k + 1 < forth.size(); ++k) CHECK(forth[k] == back[back.size() - 2 - k]);
  // The middles of the edges on the map lie on the segment in the plane, to a millionth of its length.
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  for (std::size_t k = 0; k + 1 < forth.size(); ++k) {
    const MapPoint m =
        plane.to_plane({(forth[k][0] + forth[k + 1][0]) / 2, (forth[k][1] + forth[k + 1][1]) / 2});
    const double off = ((b[0] - a[0]) * (m[1] - a[1]) - (b[1] - a[1]) * (m[0] - a[0])) / length;
    CHECK(std::abs(off) < 1e-6 * length);
  }
}

TEST_CASE("systems are known by their names") {
  const Crs utm = describe_crs("urn:ogc:def:crs:EPSG::32633");
  CHECK(!utm.geographic);
  CHECK(utm.title == "WGS 84 / UTM zone 33N");
  CHECK(utm.unit == "metre");
  CHECK(describe_crs("EPSG:2263").unit == "US survey foot");
  CHECK(describe_crs("EPSG:7415").title == "Amersfoort / RD New");  // with heights
  CHECK(is_same_crs("EPSG:4326", "OGC:CRS84"));
  CHECK(!is_same_crs("EPSG:4326", "EPSG:4269"));
  CHECK(says(refusal([] { describe_crs("EPSG:99999"); }),
             "PROJ does not know the coordinate system 'EPSG:99999'"));
  CHECK(says(refusal([] { describe_crs("EPSG:4807"); }), "in units of 'grad'"));
  CHECK(says(refusal([] { describe_crs("EPSG:4978"); }), "is not one of maps"));
}

TEST_CASE("degrees become lengths of another system") {
  const auto map = map_between("OGC:CRS84", "EPSG:3395");
  const MapPoint p = map->forward({9, 0});
  CHECK(p[0] == doctest::Approx(6378137 * 9 * radian).epsilon(1e-12));
  CHECK(std::abs(p[1]) < 1e-6);
  CHECK(map->inverse(p)[0] == doctest::Approx(9).epsilon(1e-12));
}

TEST_CASE("the areal scale of a plane") {
  const Crs utm = describe_crs("EPSG:32633"), mercator = describe_crs("EPSG:3395"),
            feet = describe_crs("EPSG:2263"), laea = describe_crs("EPSG:3035");
  CHECK(areal_scale(utm, *map_to_degrees(utm), {500000, 5e6}) ==
        doctest::Approx(0.9996 * 0.9996).epsilon(1e-7));
  const auto to_degrees = map_to_degrees(mercator);
  const MapPoint p = to_degrees->inverse({5, 60});
  const double e2 = (2 - 1 / mercator.ellipsoid.inverse_flattening) / mercator.ellipsoid.inverse_flattening;
  const double s = std::sin(60 * radian), k2 = (1 - e2 * s * s) / (1 - s * s);  // Snyder (7-8), squared
  CHECK(areal_scale(mercator, *to_degrees, p) == doctest::Approx(k2).epsilon(1e-7));
  CHECK(areal_scale(laea, *map_to_degrees(laea), {4.5e6, 2.7e6}) == doctest::Approx(1).epsilon(1e-7));
  CHECK(areal_scale(feet, *map_to_degrees(feet), {984250, 200000}) == doctest::Approx(1).epsilon(1e-3));
}
