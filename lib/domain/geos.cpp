#include "lib/domain/geos.hpp"

namespace powercell::geos {

Context::Context() : handle_(GEOS_init_r()) {
  GEOSContext_setErrorMessageHandler_r(
      handle_, [](const char* message, void* text) { *static_cast<std::string*>(text) = message; },
      &message_);
}
Context::~Context() {
  GEOS_finish_r(handle_);
}

void Context::fail(const char* operation) const {
  throw Error(ErrorCode::internal, std::string("GEOS: ") + operation + " failed: " + message_);
}

Geometry Context::own(GEOSGeometry* geometry, const char* operation) {
  if (!geometry) fail(operation);
  return Geometry(geometry, Destroy{handle_});
}

GEOSCoordSequence* Context::sequence(const std::vector<double>& xy) {
  GEOSCoordSequence* points =
      GEOSCoordSeq_copyFromBuffer_r(handle_, xy.data(), static_cast<unsigned>(xy.size() / 2), 0, 0);
  if (!points) fail("copying coordinates");
  return points;
}

Geometry Context::polygon(const IndexedRings& vertices, std::span<const IndexedRing> rings) {
  std::vector<Geometry> closed;
  for (const IndexedRing& ring : rings) {
    std::vector<double> xy;
    for (std::uint32_t v : ring.vertex) {
      xy.insert(xy.end(), {vertices.at(v)[0], vertices.at(v)[1]});
    }
    const double x = xy[0], y = xy[1];
    xy.insert(xy.end(), {x, y});
    closed.push_back(own(GEOSGeom_createLinearRing_r(handle_, sequence(xy)), "making a ring"));
  }
  std::vector<GEOSGeometry*> raw;
  for (Geometry& ring : closed) raw.push_back(ring.release());  // createPolygon owns them, even if it fails
  return own(GEOSGeom_createPolygon_r(handle_, raw[0], raw.data() + 1, static_cast<unsigned>(raw.size() - 1)),
             "making a polygon");
}

Geometry Context::multipolygon(const std::vector<Geometry>& polygons) {
  std::vector<GEOSGeometry*> raw;
  for (const Geometry& polygon : polygons) raw.push_back(GEOSGeom_clone_r(handle_, polygon.get()));
  return own(
      GEOSGeom_createCollection_r(handle_, GEOS_MULTIPOLYGON, raw.data(), static_cast<unsigned>(raw.size())),
      "making a multipolygon");
}

Geometry Context::segment(const double* a, const double* b) {
  return own(GEOSGeom_createLineString_r(handle_, sequence({a[0], a[1], b[0], b[1]})), "making a segment");
}

std::optional<std::string> Context::defect(const Geometry& geometry) {
  char* text = nullptr;
  GEOSGeometry* point = nullptr;
  const char valid = GEOSisValidDetail_r(handle_, geometry.get(), 0, &text, &point);
  const Geometry location(point, Destroy{handle_});
  std::string reason = text ? text : "";
  GEOSFree_r(handle_, text);
  if (valid == 1) return std::nullopt;
  if (valid != 0) return "cannot be checked in double precision (" + message_ + ")";
  double x = 0, y = 0;
  if (location && GEOSGeomGetX_r(handle_, location.get(), &x) == 1 &&
      GEOSGeomGetY_r(handle_, location.get(), &y) == 1)
    reason += " at " + place(x, y);
  return reason;
}

std::optional<std::string> Context::overlap(const Geometry& a, const Geometry& b) {
  const char meet = GEOSRelatePattern_r(handle_, a.get(), b.get(), "T********");
  if (meet == 0) return std::nullopt;
  if (meet != 1) return "cannot be checked for overlap in double precision (" + message_ + ")";
  std::string reason = "overlap";
  const Geometry common(GEOSIntersection_r(handle_, a.get(), b.get()), Destroy{handle_});
  if (!common) return reason;
  const Geometry inside(GEOSPointOnSurface_r(handle_, common.get()), Destroy{handle_});
  if (!inside) return reason;
  double x = 0, y = 0;
  if (GEOSGeomGetX_r(handle_, inside.get(), &x) == 1 && GEOSGeomGetY_r(handle_, inside.get(), &y) == 1)
    reason += ", for instance at " + place(x, y);
  return reason;
}

Tree::Tree(Context& context)
    : context_(context), tree_(GEOSSTRtree_create_r(context.handle_, 10), Destroy{context.handle_}) {
  if (!tree_) context.fail("making a tree");
}

void Tree::insert(const Geometry& extent, std::size_t number) {
  GEOSSTRtree_insert_r(context_.handle_, tree_.get(), extent.get(), reinterpret_cast<void*>(number));
}

void Tree::query(const Geometry& extent, const std::function<void(std::size_t)>& visit) {
  GEOSSTRtree_query_r(
      context_.handle_, tree_.get(), extent.get(),
      [](void* number, void* function) {
        (*static_cast<const std::function<void(std::size_t)>*>(function))(
            reinterpret_cast<std::size_t>(number));
      },
      const_cast<std::function<void(std::size_t)>*>(&visit));
}

}  // namespace powercell::geos
