/// \file
/// Coordinate reference systems of maps. PROJ is behind them, in map_crs.cpp alone.
#pragma once

#include <array>
#include <memory>
#include <string>

namespace powercell::io {

/// Longitude and latitude in degrees, or easting and northing, whatever order the system itself has.
using MapPoint = std::array<double, 2>;

/// A map from points to points and back. Not for several threads at a time.
class PointMap {
 public:
  virtual ~PointMap() = default;
  /// \throw Error invalid_argument for points that have no image
  virtual MapPoint forward(MapPoint point) const = 0;
  virtual MapPoint inverse(MapPoint point) const = 0;
};

struct Ellipsoid {
  double a = 0;                   ///< semi-major axis in metres
  double inverse_flattening = 0;  ///< 0 for a sphere
};

/// What PROJ knows of a system.
struct Crs {
  std::string name;         ///< as given: "EPSG:4326", "urn:ogc:def:crs:EPSG::32633", a PROJ string, WKT
  std::string title;        ///< "WGS 84 / UTM zone 33N"
  bool geographic = false;  ///< longitude and latitude in degrees; else a plane
  std::string unit;         ///< of the coordinates: "degree", "metre", "US survey foot"
  double metres = 1;        ///< in a unit of length
  Ellipsoid ellipsoid;
};

/// \throw Error invalid_argument: PROJ does not know it, or it is not of a map in degrees or lengths
Crs describe_crs(const std::string& name);

/// Whether a system is in degrees; false for an empty name and for one that PROJ does not know. Where PROJ
/// has no data at all, the usual names of WGS 84 are known nevertheless.
bool is_in_degrees(const std::string& name);

/// Whether two names mean the same coordinates.
bool is_same_crs(const std::string& a, const std::string& b);

/// From the coordinates of one system to those of another.
/// \throw Error invalid_argument
std::unique_ptr<PointMap> map_between(const std::string& from, const std::string& to);

/// To longitude and latitude of the system's own datum.
/// \throw Error invalid_argument
std::unique_ptr<PointMap> map_to_degrees(const Crs& crs);

/// Lambert's azimuthal equal-area projection of longitude and latitude on an ellipsoid. Longitudes are
/// within 180 degrees of the centre's.
struct EqualArea {
  std::unique_ptr<PointMap> map;  ///< from degrees to metres
  std::string definition;         ///< for PROJ: "+proj=laea +lat_0=41.85 ..."
};
EqualArea equal_area(const Ellipsoid& ellipsoid, MapPoint centre);

}  // namespace powercell::io
