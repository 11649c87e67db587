/// \file
/// GEOS geometries as owned objects, and conversion to and from rings.
#pragma once

#include <geos_c.h>

#include <array>
#include <memory>
#include <powercell/domain.hpp>
#include <string>
#include <vector>

namespace powercell::io {

/// A GEOS context that keeps its last message; geometries must not outlive it.
class Geos {
 public:
  Geos();
  struct Delete {
    GEOSContextHandle_t handle;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Delete>;

  GEOSContextHandle_t handle() const { return handle_.get(); }
  Geometry own(GEOSGeometry* geometry) const { return Geometry(geometry, Delete{handle()}); }
  const std::string& message() const { return message_; }  ///< of the last failure

  /// These return null on failure, as GEOS calls do.
  Geometry line(const Ring& ring) const;  ///< closed: the first point is repeated if needed
  Geometry polygon(const PolygonPart& part) const;
  Geometry collection(int type, std::vector<Geometry> members) const;

  /// Appends the polygons in `geometry`, at any depth. False if it also contains other geometries.
  bool parts(const GEOSGeometry* geometry, std::vector<PolygonPart>& out) const;
  /// Coordinates of a point, or of the one member of a multipoint; z is not a number if there is none.
  /// Returns what it is if it is neither, else nothing.
  std::string point(const GEOSGeometry* geometry, std::array<double, 3>& out) const;

 private:
  struct Finish {
    void operator()(GEOSContextHandle_HS* handle) const { GEOS_finish_r(handle); }
  };
  GEOSGeometry* linear(const Ring& ring, bool as_ring) const;
  Ring ring(const GEOSGeometry* geometry) const;

  std::string message_;
  std::unique_ptr<GEOSContextHandle_HS, Finish> handle_;
};

}  // namespace powercell::io
