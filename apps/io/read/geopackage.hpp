/// \file
/// GeoPackage (OGC 12-128), with SQLite and GEOS.
#pragma once

#include <string>
#include <vector>

#include "apps/io/read/polygons.hpp"
#include "apps/io/tables/feature_rows.hpp"

namespace powercell::io {

/// Whether a name is that of a GeoPackage, `maps.gpkg`, or of a layer in one, `maps.gpkg:shops`.
bool is_geopackage(const std::string& name);

/// The points of a layer, with all columns but geometries and blobs. Without the name of a layer, the file
/// has one of points.
/// \throw Error invalid_file
FeatureRows read_geopackage_points(const std::string& name, std::size_t dimension);

/// The union of the polygons of a layer. Without the name of a layer, the file has one of polygons.
/// \throw Error invalid_file
std::vector<PolygonPart> read_geopackage_polygons(const std::string& name, NamedCrs* crs);

}  // namespace powercell::io
