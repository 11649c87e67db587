#include "apps/io/read/geos.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "apps/io/read/file.hpp"
#include "apps/io/read/polygons.hpp"

namespace powercell::io {

Geos::Geos() : handle_(GEOS_init_r()) {
  GEOSContext_setErrorMessageHandler_r(
      handle(), [](const char* message, void* self) { static_cast<Geos*>(self)->message_ = message; }, this);
}

GEOSGeometry* Geos::linear(const Ring& ring, bool as_ring) const {
  const bool closed = !ring.empty() && ring.front() == ring.back();
  const auto size = static_cast<unsigned>(ring.size() + (closed || ring.empty() ? 0 : 1));
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(handle(), size, 2);
  if (sequence == nullptr) return nullptr;
  for (unsigned k = 0; k < size; ++k) {
    const auto& p = ring[k < ring.size() ? k : 0];
    GEOSCoordSeq_setXY_r(handle(), sequence, k, p[0], p[1]);
  }
  return as_ring ? GEOSGeom_createLinearRing_r(handle(), sequence)
                 : GEOSGeom_createLineString_r(handle(), sequence);
}

Geos::Geometry Geos::line(const Ring& ring) const {
  return own(linear(ring, false));
}

Geos::Geometry Geos::polygon(const PolygonPart& part) const {
  Geometry shell = own(linear(part.outer, true));
  std::vector<Geometry> holes;
  for (const Ring& hole : part.holes) {
    holes.push_back(own(linear(hole, true)));
    if (!holes.back()) return own(nullptr);
  }
  if (!shell) return shell;
  std::vector<GEOSGeometry*> pointers;
  for (Geometry& hole : holes) pointers.push_back(hole.release());  // GEOS owns them, also on failure
  return own(GEOSGeom_createPolygon_r(handle(), shell.release(), pointers.data(),
                                      static_cast<unsigned>(pointers.size())));
}

Geos::Geometry Geos::collection(int type, std::vector<Geometry> members) const {
  std::vector<GEOSGeometry*> pointers;
  for (Geometry& member : members) pointers.push_back(member.release());
  return own(
      GEOSGeom_createCollection_r(handle(), type, pointers.data(), static_cast<unsigned>(pointers.size())));
}

Ring Geos::ring(const GEOSGeometry* geometry) const {
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(handle(), geometry);
  unsigned size = 0;
  GEOSCoordSeq_getSize_r(handle(), sequence, &size);
  Ring ring(size);
  for (unsigned k = 0; k < size; ++k) GEOSCoordSeq_getXY_r(handle(), sequence, k, &ring[k][0], &ring[k][1]);
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

bool Geos::parts(const GEOSGeometry* geometry, std::vector<PolygonPart>& out) const {
  const int type = GEOSGeomTypeId_r(handle(), geometry);
  if (type == GEOS_POLYGON) {
    if (GEOSisEmpty_r(handle(), geometry) != 0) return true;
    PolygonPart part;
    part.outer = ring(GEOSGetExteriorRing_r(handle(), geometry));
    const int holes = GEOSGetNumInteriorRings_r(handle(), geometry);
    for (int k = 0; k < holes; ++k) part.holes.push_back(ring(GEOSGetInteriorRingN_r(handle(), geometry, k)));
    out.push_back(std::move(part));
    return true;
  }
  if (type != GEOS_MULTIPOLYGON && type != GEOS_GEOMETRYCOLLECTION) return false;
  bool polygons_only = true;
  const int members = GEOSGetNumGeometries_r(handle(), geometry);
  for (int k = 0; k < members; ++k) {
    polygons_only = parts(GEOSGetGeometryN_r(handle(), geometry, k), out) && polygons_only;
  }
  return polygons_only;
}

std::string Geos::point(const GEOSGeometry* geometry, std::array<double, 3>& out) const {
  if (GEOSisEmpty_r(handle(), geometry) != 0) return "an empty geometry";
  const int type = GEOSGeomTypeId_r(handle(), geometry);
  if (type == GEOS_MULTIPOINT && GEOSGetNumGeometries_r(handle(), geometry) == 1)
    return point(GEOSGetGeometryN_r(handle(), geometry, 0), out);
  if (type == GEOS_MULTIPOINT) return "several points; split them into features of one point";
  if (type != GEOS_POINT) return "not a point; seeds are points";
  out[2] = std::numeric_limits<double>::quiet_NaN();
  GEOSGeomGetX_r(handle(), geometry, &out[0]);
  GEOSGeomGetY_r(handle(), geometry, &out[1]);
  if (GEOSHasZ_r(handle(), geometry) == 1) GEOSGeomGetZ_r(handle(), geometry, &out[2]);
  return {};
}

namespace {

void require_valid(const Geos& geos, const GEOSGeometry* geometry, std::size_t group,
                   const std::string& name) {
  char* reason = nullptr;
  GEOSGeometry* where = nullptr;
  const char valid = GEOSisValidDetail_r(geos.handle(), geometry, 0, &reason, &where);
  const Geos::Geometry place = geos.own(where);
  std::string words = reason == nullptr ? "not valid" : reason;
  if (reason != nullptr) GEOSFree_r(geos.handle(), reason);
  if (valid == 1) return;
  double x = 0, y = 0;
  if (place && GEOSGeomGetX_r(geos.handle(), place.get(), &x) == 1 &&
      GEOSGeomGetY_r(geos.handle(), place.get(), &y) == 1) {
    words += fmt::format(" at ({}, {})", x, y);
  }
  throw Error(ErrorCode::invalid_domain,
              fmt::format("{}: polygon {} (from 0): {}; repair it first", name, group, words));
}

}  // namespace

std::vector<PolygonPart> unite(const std::vector<std::vector<PolygonPart>>& groups, const std::string& name) {
  if (groups.size() == 1) return groups.front();
  Geos geos;
  std::vector<Geos::Geometry> members;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<Geos::Geometry> polygons;
    for (const PolygonPart& part : groups[g]) {
      polygons.push_back(geos.polygon(part));
      if (!polygons.back()) {
        throw Error(ErrorCode::invalid_domain,
                    fmt::format("{}: polygon {} (from 0): {}", name, g, geos.message()));
      }
    }
    members.push_back(geos.collection(GEOS_MULTIPOLYGON, std::move(polygons)));
    require_valid(geos, members.back().get(), g, name);
  }
  const Geos::Geometry all = geos.collection(GEOS_GEOMETRYCOLLECTION, std::move(members));
  const Geos::Geometry united = geos.own(GEOSUnaryUnion_r(geos.handle(), all.get()));
  if (!united) fail_file(name, fmt::format("its polygons cannot be united: {}", geos.message()));
  std::vector<PolygonPart> parts;
  geos.parts(united.get(), parts);
  return parts;
}

}  // namespace powercell::io
