/// \file
/// The cells of a polygon domain as GeoJSON.
#pragma once

#include <string>

#include "apps/io/output.hpp"

namespace powercell::io {

/// A FeatureCollection with a Feature for each seed in input order: a Polygon, a MultiPolygon where a
/// cell has several parts, or null where it is empty; properties `seed`, `weight`, `status`, `measure`.
/// Coordinates are those of the domain's file. \throw Error write_failed
void write_geojson(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
