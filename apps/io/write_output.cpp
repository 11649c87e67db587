#include <algorithm>
#include <array>

#include "apps/io/output.hpp"
#include "apps/io/picture.hpp"
#include "apps/io/read_file.hpp"
#include "apps/io/write_formats.hpp"

namespace powercell::io {
namespace {

struct Format {
  std::string_view extension;
  bool flat_only;  // vector pictures and GeoJSON, which only polygons have
  void (*write)(const std::string& path, const DiagramOutput& output);
};

constexpr std::array<Format, 10> formats = {{
    {".svg", true, write_svg},
    {".png", false, write_png},
    {".pdf", true, write_pdf},
    {".vtu", false, write_vtu},
    {".vtp", false, write_vtp},
    {".obj", false, write_obj},
    {".ply", false, write_ply},
    {".off", false, write_off},
    {".json", false, write_json},
    {".geojson", true, write_geojson},
}};

const Format& format_of(const std::string& path) {
  check_output_format(path);
  return *std::ranges::find(formats, lower_extension(path), &Format::extension);
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

void check_output(const std::string& path, DomainKind kind) {
  const Format& format = format_of(path);
  if (!format.flat_only || kind == DomainKind::polygon) return;
  throw Error(ErrorCode::unsupported,
              path + ": " + std::string(format.extension) +
                  " holds flat shapes, of polygon domains; for a surface or volume use .png for a picture, "
                  ".vtu for geometry");
}

void write_output(const std::string& path, const DiagramOutput& output) {
  check_output(path, output.domain.kind());
  format_of(path).write(path, output);
}

}  // namespace powercell::io
