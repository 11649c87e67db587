#include "apps/io/read/svg_fill.hpp"

#include <fmt/format.h>

#include "apps/io/read/file.hpp"
#include "apps/io/read/geos.hpp"

namespace powercell::io {
namespace {

// The winding number of `ring` about a point, counter-clockwise positive.
int winding(const Ring& ring, double x, double y) {
  int turns = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto &a = ring[k], &b = ring[(k + 1) % ring.size()];
    if ((a[1] <= y) == (b[1] <= y)) continue;
    const double side = (b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1]);
    if (b[1] > a[1] && side > 0) ++turns;
    if (b[1] < a[1] && side < 0) --turns;
  }
  return turns;
}

}  // namespace

// GEOS splits the lines where they cross and forms the faces between them; the filled faces are united.
std::vector<PolygonPart> fill(const std::vector<Ring>& rings, bool even_odd, const std::string& name) {
  Geos geos;
  const auto checked = [&](Geos::Geometry geometry) {
    if (!geometry) fail_file(name, fmt::format("its outlines cannot form a polygon: {}", geos.message()));
    return geometry;
  };
  std::vector<Geos::Geometry> lines;
  for (const Ring& ring : rings) {
    if (ring.size() >= 3) lines.push_back(checked(geos.line(ring)));
  }
  if (lines.empty()) return {};
  const Geos::Geometry all = checked(geos.collection(GEOS_MULTILINESTRING, std::move(lines)));
  const Geos::Geometry noded = checked(geos.own(GEOSUnaryUnion_r(geos.handle(), all.get())));
  const GEOSGeometry* input = noded.get();
  const Geos::Geometry faces = checked(geos.own(GEOSPolygonize_r(geos.handle(), &input, 1)));

  std::vector<Geos::Geometry> filled;
  const int count = GEOSGetNumGeometries_r(geos.handle(), faces.get());
  for (int k = 0; k < count; ++k) {
    const GEOSGeometry* face = GEOSGetGeometryN_r(geos.handle(), faces.get(), k);
    const Geos::Geometry inside = checked(geos.own(GEOSPointOnSurface_r(geos.handle(), face)));
    double x = 0, y = 0;
    if (GEOSGeomGetX_r(geos.handle(), inside.get(), &x) != 1 ||
        GEOSGeomGetY_r(geos.handle(), inside.get(), &y) != 1)
      continue;
    int turns = 0;
    for (const Ring& ring : rings) turns += winding(ring, x, y);
    if (even_odd ? turns % 2 != 0 : turns != 0)
      filled.push_back(checked(geos.own(GEOSGeom_clone_r(geos.handle(), face))));
  }
  if (filled.empty()) return {};
  const Geos::Geometry together = checked(geos.collection(GEOS_MULTIPOLYGON, std::move(filled)));
  const Geos::Geometry united = checked(geos.own(GEOSUnaryUnion_r(geos.handle(), together.get())));
  std::vector<PolygonPart> parts;
  geos.parts(united.get(), parts);
  return parts;
}

}  // namespace powercell::io
