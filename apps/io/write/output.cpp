#include "apps/io/write/output.hpp"

#include <algorithm>
#include <array>

#include "apps/io/picture/picture.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/write/formats.hpp"

namespace powercell::io {
namespace {

/// What domains a format is for.
enum class For {
  all,
  polygons,       ///< vector pictures and GeoJSON
  volumes,        ///< closed surfaces
  flat_or_solid,  ///< tessellations of the plane and of space
};

struct Format {
  std::string_view extension;
  For domains;
  void (*write)(const std::string& path, const DiagramOutput& output);
};

constexpr std::array<Format, 14> formats = {{
    {".svg", For::polygons, write_svg},
    {".png", For::all, write_png},
    {".pdf", For::polygons, write_pdf},
    {".vtu", For::all, write_vtu},
    {".vtp", For::all, write_vtp},
    {".obj", For::all, write_obj},
    {".ply", For::all, write_ply},
    {".off", For::all, write_off},
    {".stl", For::volumes, write_stl},
    {".msh", For::all, write_gmsh},
    {".tess", For::flat_or_solid, write_tess},
    {".json", For::all, write_json},
    {".geojson", For::polygons, write_geojson},
    {".html", For::all, write_html},
}};

/// Why a format is not for a domain; empty if it is.
std::string refusal(For domains, const Domain& domain) {
  const DomainKind kind = domain.kind();
  if (domains == For::polygons && kind != DomainKind::polygon)
    return "holds flat shapes, of polygon domains; for a surface or volume use .png for a picture, .vtu for "
           "geometry";
  if (domains == For::volumes && kind != DomainKind::volume)
    return "holds closed bodies, of volumes; for cells of a polygon or surface use .obj, .ply or .vtp";
  if (domains == For::flat_or_solid && kind == DomainKind::surface)
    return "holds tessellations of polygons and volumes; for cells of a surface use .vtu or .msh";
  if (domains == For::flat_or_solid && domain.is_periodic())
    return "is written for bounded domains only; for a periodic one use .vtu, .msh or .json";
  return {};
}

const Format& format_of(const std::string& path) {
  check_output_format(path);
  return *std::ranges::find(formats, lower_extension(path), &Format::extension);
}

void check_seeds_in_view(const std::string& path, DomainKind kind, std::size_t seeds) {
  const std::size_t most = most_seeds_in_view * (kind == DomainKind::volume ? 1 : 4);
  if (seeds <= most) return;
  throw Error(ErrorCode::unsupported,
              path + ": " + with_commas(seeds) + " seeds are too many for a page, which holds up to " +
                  with_commas(most) + (kind == DomainKind::volume ? " in a volume" : "") +
                  "; write .vtu or .vtp for other programs, or .png for a picture");
}

}  // namespace

std::string_view known_outputs() {
  static const std::string list = [] {
    std::string text;
    for (const Format& format : formats) text += (text.empty() ? "" : " ") + std::string(format.extension);
    return text;
  }();
  return list;
}

void check_output_format(const std::string& path) {
  check_extension(path, known_outputs());
}

void check_output(const std::string& path, const Domain& domain, std::size_t seeds) {
  const Format& format = format_of(path);
  if (format.write == write_html) check_seeds_in_view(path, domain.kind(), seeds);
  const std::string why = refusal(format.domains, domain);
  if (!why.empty())
    throw Error(ErrorCode::unsupported, path + ": " + std::string(format.extension) + " " + why);
}

void write_output(const std::string& path, const DiagramOutput& output) {
  check_output(path, output.domain, output.seeds.size());
  format_of(path).write(path, output);
}

}  // namespace powercell::io
