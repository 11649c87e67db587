/// \file
/// Readers of polygons. A reader takes the bytes of a file and its name for messages, and throws Error
/// invalid_file. Domain::polygon checks the rings.
#pragma once

#include <optional>
#include <powercell/domain.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "apps/io/read/mesh.hpp"

namespace powercell::io {

/// The coordinate reference system that a file of polygons says it is in.
struct NamedCrs {
  std::string name;    ///< "EPSG:4326", "urn:ogc:def:crs:EPSG::32633"; empty if it does not say
  std::string member;  ///< JSON of the member `crs` of a GeoJSON file; empty without one
};

/// Polygon, MultiPolygon, GeometryCollection, Feature or FeatureCollection. Coordinates are those of the
/// file, whatever its system. Several geometries are united.
/// \param crs  if not null, the file's system
std::vector<PolygonPart> parse_geojson(std::string_view text, const std::string& name,
                                       NamedCrs* crs = nullptr);

/// One or more of POLYGON, MULTIPOLYGON and GEOMETRYCOLLECTION, also EMPTY; several are united. An `SRID=n;`
/// in front must be the same for all.
/// \param crs  if not null, EPSG:n
std::vector<PolygonPart> parse_wkt(std::string_view text, const std::string& name, NamedCrs* crs = nullptr);

/// Largest distance between a curve of an SVG file and its polygon, over the diagonal of the drawing.
inline constexpr double svg_tolerance = 1e-4;

/// All path, polygon, polyline, rect, circle and ellipse elements, whatever their paint, and the copies that
/// `use` makes of elements of the file, except those in defs, symbol, clipPath, mask, marker, pattern or
/// foreignObject, those of other namespaces and those with display: none; of a switch the first child that
/// applies. Transforms are applied, each element is filled by its fill-rule, and the elements are united.
/// Properties come from attributes, `style` and style sheets with simple selectors (read_svg_style.hpp).
/// Refused: clip-path, mask, transforms in CSS. SVG's y axis points down: y = -y(SVG).
std::vector<PolygonPart> parse_svg(std::string_view text, const std::string& name);

/// A polygon or a mesh.
struct DomainArrays {
  DomainKind kind = DomainKind::polygon;
  std::vector<PolygonPart> parts;       ///< polygon
  std::vector<double> vertices;         ///< surface, volume: nv x 3
  std::vector<std::uint32_t> elements;  ///< surface: nt x 3; volume: nt x 4
  NamedCrs crs = {};                    ///< polygon
  std::optional<Domain> exact =
      {};              ///< a box or a lattice, of which the others are a copy; else made of them
  bool solid = false;  ///< surface: stands for its inside
};

/// Plain text: `nv nf`, nv rows of 2 or 3 coordinates, nf rows of indices from 0, all with or without their
/// number in front; refused if only the reading without it uses all points. 2 coordinates: polygons, which
/// are united. 3 coordinates: triangles (or larger faces) or tetrahedra, by the length of the rows, or by
/// `kind` if that is ambiguous.
DomainArrays parse_plain(std::string_view text, std::optional<DomainKind> kind, const std::string& name);

/// The union of groups of parts, each a valid polygon.
/// \throw Error invalid_file, invalid_domain if a group is not valid (which, where)
std::vector<PolygonPart> unite(const std::vector<std::vector<PolygonPart>>& groups, const std::string& name);

}  // namespace powercell::io
