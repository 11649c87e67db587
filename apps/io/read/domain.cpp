#include "apps/io/read/domain.hpp"

#include <fmt/format.h>

#include <array>

#include "apps/io/names.hpp"
#include "apps/io/read/domain_box.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/foreign_files.hpp"
#include "apps/io/read/geopackage.hpp"

namespace powercell::io {
namespace {

struct MeshFormat {
  const char* extension;
  MeshFile (*parse)(std::string_view, const std::string&);
};
constexpr MeshFormat mesh_formats[] = {{".off", parse_off}, {".obj", parse_obj},    {".ply", parse_ply},
                                       {".stl", parse_stl}, {".mesh", parse_medit}, {".msh", parse_gmsh},
                                       {".vtk", parse_vtk}, {".vtu", parse_vtu},    {".tet", parse_tet}};

DomainArrays polygon_arrays(std::vector<PolygonPart> parts, NamedCrs crs, std::optional<DomainKind> kind,
                            const std::string& name) {
  if (kind.value_or(DomainKind::polygon) != DomainKind::polygon) {
    fail_file(name, fmt::format("holds a polygon, but a {} is wanted; choose another domain or kind",
                                io::name(*kind)));
  }
  DomainArrays arrays;
  arrays.parts = std::move(parts);
  arrays.crs = std::move(crs);
  return arrays;
}

Domain make_domain(const DomainArrays& arrays) {
  if (arrays.exact) return *arrays.exact;
  switch (arrays.kind) {
    case DomainKind::polygon:
      return Domain::polygon(arrays.parts);
    case DomainKind::surface:
      return arrays.solid ? Domain::solid(arrays.vertices, arrays.elements)
                          : Domain::surface(arrays.vertices, arrays.elements);
    default:
      return Domain::volume(arrays.vertices, arrays.elements);
  }
}

}  // namespace

std::string describe(const DomainArrays& arrays, const std::string& spec) {
  if (arrays.exact) return describe_box(*arrays.exact, spec);
  if (arrays.kind == DomainKind::polygon) {
    std::size_t holes = 0, points = 0;
    for (const PolygonPart& part : arrays.parts) {
      holes += part.holes.size();
      points += part.outer.size();
      for (const Ring& hole : part.holes) points += hole.size();
    }
    const auto counted = [](std::size_t count, const char* what) {
      return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
    };
    return fmt::format("{}: polygon, {}, {}, {} points", spec, counted(arrays.parts.size(), "part"),
                       counted(holes, "hole"), points);
  }
  const bool volume = arrays.kind == DomainKind::volume;
  return fmt::format("{}: {}, {} vertices, {} {}", spec, arrays.solid ? "solid" : io::name(arrays.kind),
                     arrays.vertices.size() / 3, arrays.elements.size() / (volume ? 4 : 3),
                     volume ? "tetrahedra" : "triangles");
}

DomainArrays parse_domain(std::string_view bytes, const std::string& extension,
                          std::optional<DomainKind> kind, const std::string& name) {
  NamedCrs crs;
  if (extension == ".geojson" || extension == ".json") {
    std::vector<PolygonPart> parts = parse_geojson(bytes, name, &crs);
    return polygon_arrays(std::move(parts), std::move(crs), kind, name);
  }
  if (extension == ".wkt") {
    std::vector<PolygonPart> parts = parse_wkt(bytes, name, &crs);
    return polygon_arrays(std::move(parts), std::move(crs), kind, name);
  }
  if (extension == ".svg") return polygon_arrays(parse_svg(bytes, name), {}, kind, name);
  if (extension == ".txt") return parse_plain(bytes, kind, name);
  for (const MeshFormat& format : mesh_formats) {
    if (extension != format.extension) continue;
    MeshArrays mesh = choose_elements(format.parse(bytes, name), kind, name);
    return {mesh.kind, {}, std::move(mesh.vertices), std::move(mesh.elements), {}};
  }
  refuse_foreign_map(extension, name);
  refuse_foreign_mesh(extension, name);
  fail_file(
      name,
      fmt::format(
          "unknown extension '{}'; a domain is .geojson .json .gpkg .wkt .svg (polygon), .off .obj .ply "
          ".stl (surface), .mesh .msh .vtu .vtk .tet (tetrahedra), .txt (plain), or one of square cube "
          "disk ball sphere torus, box:LX,LY[,LZ]:HX,HY[,HZ], lattice:ax,ay/bx,by",
          extension));
}

DomainArrays read_domain_arrays(const std::string& spec, std::optional<DomainKind> kind) {
  if (is_geopackage(spec)) {
    NamedCrs crs;
    std::vector<PolygonPart> parts = read_geopackage_polygons(spec, &crs);
    return polygon_arrays(std::move(parts), std::move(crs), kind, spec);
  }
  if (!is_builtin_domain(spec))
    return parse_domain(read_file(spec, builtin_domain_names()), lower_extension(spec), kind, spec);
  DomainArrays arrays = builtin_domain(spec);
  if (kind.value_or(arrays.kind) != arrays.kind)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("domain {} is a {}, but a {} is wanted; choose another domain or kind", spec,
                            io::name(arrays.kind), io::name(*kind)));
  return arrays;
}

LoadedDomain load_domain(DomainArrays arrays, const std::string& spec) {
  try {
    Domain domain = make_domain(arrays);
    std::string description = describe(arrays, spec);
    return {std::move(domain),          std::move(description),     std::move(arrays.parts),
            std::move(arrays.vertices), std::move(arrays.elements), std::move(arrays.crs)};
  } catch (const Error& error) {
    throw Error(error.code(),
                fmt::format("{}: {}", spec, error.what()));  // the library does not know the file
  }
}

LoadedDomain read_domain(const std::string& spec, std::optional<DomainKind> kind,
                         const std::string& periodic) {
  DomainArrays arrays = read_domain_arrays(spec, kind);
  make_periodic(arrays, periodic, spec);
  return load_domain(std::move(arrays), spec);
}

}  // namespace powercell::io
