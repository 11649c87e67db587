/// \file
/// The argument of --domain: a file or the name of a built-in shape.
#pragma once

#include <cstdint>
#include <optional>
#include <powercell/domain.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "apps/io/read/polygons.hpp"

namespace powercell::io {

/// A domain with the arrays it was made from.
struct LoadedDomain {
  Domain domain;
  std::string description;              ///< e.g. "bunny.off: surface, 2503 vertices, 4968 triangles"
  std::vector<PolygonPart> parts;       ///< polygon: its rings; else empty
  std::vector<double> vertices;         ///< surface, volume: nv x 3; else empty
  std::vector<std::uint32_t> elements;  ///< surface: nt x 3; volume: nt x 4; else empty
  NamedCrs crs = {};                    ///< polygon
};

/// \param spec  a file (.geojson .json .gpkg .wkt .svg; .off .obj .ply .stl; .mesh .msh .vtu .vtk .tet; .txt
///   of the paper's kind), or square, cube (unit, from 0 to 1), disk[:N], ball[:N], sphere[:N] (radius 1
///   about 0), torus[:N] (N: resolution), or as parse_box() says (domain_box.hpp)
/// \param kind  for files that can be read as more than one kind (a mesh with faces and solids)
/// \param periodic  axes along which a box becomes periodic, e.g. "xz"; empty for none
/// \throw Error invalid_file (file and line), invalid_domain (file and element), invalid_argument
LoadedDomain read_domain(const std::string& spec, std::optional<DomainKind> kind = std::nullopt,
                         const std::string& periodic = {});

/// The two steps of it: the arrays of a file or a built-in shape, which may be projected
/// (map_projection.hpp), and the domain that they make.
DomainArrays read_domain_arrays(const std::string& spec, std::optional<DomainKind> kind);
std::string describe(const DomainArrays& arrays, const std::string& spec);
LoadedDomain load_domain(DomainArrays arrays, const std::string& spec);

/// The arrays from memory.
/// \param extension lower case with its dot, e.g. ".off"
DomainArrays parse_domain(std::string_view bytes, const std::string& extension,
                          std::optional<DomainKind> kind, const std::string& name);

/// The arrays of a built-in shape, and whether `spec` names one.
bool is_builtin_domain(const std::string& spec);
/// "square" and so on; the last ones, "box:" and "lattice:", need numbers behind them.
std::vector<std::string> builtin_domain_names();
DomainArrays builtin_domain(const std::string& spec);

}  // namespace powercell::io
