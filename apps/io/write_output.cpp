#include <algorithm>
#include <array>
#include <filesystem>
#include <powercell/error.hpp>

#include "apps/io/output.hpp"
#include "apps/io/picture.hpp"
#include "apps/io/write_geojson.hpp"
#include "apps/io/write_json.hpp"
#include "apps/io/write_mesh.hpp"
#include "apps/io/write_vtk.hpp"

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

const Format* find_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
  const auto found = std::find_if(formats.begin(), formats.end(),
                                  [&](const Format& format) { return format.extension == extension; });
  return found == formats.end() ? nullptr : &*found;
}

const Format& checked_format(const std::string& path, DomainKind kind) {
  check_output_format(path);
  const Format* format = find_format(path);
  if (format->flat_only && kind != DomainKind::polygon) {
    throw Error(ErrorCode::unsupported,
                path + ": " + std::string(format->extension) +
                    " holds flat shapes, of polygon domains; for a surface or volume use .png for a picture, "
                    ".vtu for geometry");
  }
  return *format;
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

bool known_output(const std::string& path) {
  return find_format(path) != nullptr;
}

void check_output_format(const std::string& path) {
  if (!known_output(path))
    throw Error(ErrorCode::invalid_file,
                path + ": unknown extension of an output file; known are " + std::string(known_outputs()));
}

void check_output(const std::string& path, DomainKind kind) {
  (void)checked_format(path, kind);
}

void write_output(const std::string& path, const DiagramOutput& output) {
  checked_format(path, output.domain.kind()).write(path, output);
}

}  // namespace powercell::io
