/// \file
/// Polygons of maps in an equal-area plane, and back.
#pragma once

#include <memory>
#include <powercell/domain.hpp>
#include <string>
#include <vector>

#include "apps/io/maps/crs.hpp"

namespace powercell::io {

/// The plane that a map is projected to. Edges are straight in the coordinates of the map, as GeoJSON has
/// them, so they are curves in the plane, traced by short segments within `tolerance` of them.
class MapPlane {
 public:
  /// Lambert's equal-area plane about the middle of the polygons, which are given in the coordinates of
  /// `crs`.
  /// \throw Error invalid_argument, invalid_domain (polygons that reach around the globe)
  MapPlane(const Crs& crs, std::vector<PolygonPart> parts);

  /// The polygons in the plane, in metres.
  const std::vector<PolygonPart>& parts() const { return parts_; }
  /// The same in the coordinates of the map, with all longitudes within 180 degrees of the middle.
  const std::vector<PolygonPart>& map_parts() const { return map_parts_; }

  MapPoint to_plane(MapPoint map) const;
  MapPoint to_map(MapPoint plane) const;
  /// To a hundredth of a millimetre, for files: vertices of the input come back as they were.
  MapPoint rounded(MapPoint map) const;
  /// A longitude within 180 degrees of the middle; other coordinates as they are.
  MapPoint unwrapped(MapPoint map) const;

  /// The points after `from` of a path in the coordinates of the map, rounded, whose straight edges stay
  /// within the tolerance of the segment in the plane; `to` is the last. The reverse of the segment has the
  /// same points.
  void trace_to_map(MapPoint from, MapPoint to, std::vector<MapPoint>& path) const;

  const std::string& definition() const { return projection_.definition; }  ///< for PROJ
  MapPoint middle() const { return middle_; }                               ///< degrees
  /// Largest relative error of a distance in the plane.
  double distortion() const { return distortion_; }

 private:
  Ring traced(const Ring& ring, double tolerance) const;
  double deviation(MapPoint a, MapPoint b, MapPoint plane_a, MapPoint plane_b) const;
  void check_area(const std::vector<PolygonPart>& parts) const;

  Crs crs_;
  std::unique_ptr<PointMap> degrees_;  // from the coordinates of the map
  MapPoint middle_{};
  EqualArea projection_;
  double tolerance_ = 0, distortion_ = 0;
  std::vector<PolygonPart> map_parts_, parts_;
};

/// An area in the plane of a system's coordinates over that on the ground, at a point; not a number where
/// longitudes and latitudes do not reach.
double areal_scale(const Crs& crs, const PointMap& to_degrees, MapPoint point);

/// Area of a ring of straight edges in longitude and latitude, on the ellipsoid; positive if
/// counter-clockwise.
double ring_area(const Ellipsoid& ellipsoid, const Ring& degrees);

}  // namespace powercell::io
