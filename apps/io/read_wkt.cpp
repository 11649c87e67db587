// Well-known text, by GEOS's reader. A file may hold several geometries, one after the other; GEOS takes
// one at a time, so the text is split where the parentheses close.
#include <fmt/format.h>

#include <cmath>

#include "apps/io/read_file.hpp"
#include "apps/io/read_geos.hpp"
#include "apps/io/read_polygons.hpp"
#include "apps/io/read_text.hpp"

namespace powercell::io {
namespace {

constexpr int kDeepestNesting = 64;  // GEOS reads collections by recursion

// The text of the next geometry, without blanks before it; empty at the end. `at` moves behind it.
std::string_view next_geometry(std::string_view text, std::size_t& at, const std::string& name) {
  at = std::min(text.find_first_not_of(" \t\r\n;", at), text.size());
  const std::size_t begin = at;
  int depth = 0;
  bool opened = false;
  for (; at < text.size() && !(opened && depth == 0); ++at) {
    if (text[at] == '(') {
      opened = true;
      if (++depth > kDeepestNesting) fail_line(name, line_of(text, at), "parentheses are nested too deeply");
    } else if (text[at] == ')' && --depth < 0) {
      fail_line(name, line_of(text, at), "a parenthesis closes that was not opened");
    } else if (text[at] == '\0') {
      fail_line(name, line_of(text, at), "a NUL byte; is this a text file?");
    }
  }
  if (depth != 0)
    fail_line(name, line_of(text, begin), "a geometry whose parentheses do not close; the file is truncated");
  return text.substr(begin, at - begin);
}

void require_finite(const std::vector<PolygonPart>& parts, std::size_t line, const std::string& name) {
  const auto check = [&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (!std::isfinite(ring[k][0]) || !std::isfinite(ring[k][1]))
        fail_line(name, line, fmt::format("point {} of a ring is not finite", k));
    }
  };
  for (const PolygonPart& part : parts) {
    check(part.outer);
    for (const Ring& hole : part.holes) check(hole);
  }
}

}  // namespace

std::vector<PolygonPart> parse_wkt(std::string_view text, const std::string& name) {
  Geos geos;
  struct Destroy {
    GEOSContextHandle_t handle;
    void operator()(GEOSWKTReader* reader) const { GEOSWKTReader_destroy_r(handle, reader); }
  };
  const std::unique_ptr<GEOSWKTReader, Destroy> reader(GEOSWKTReader_create_r(geos.handle()),
                                                       Destroy{geos.handle()});
  std::vector<std::vector<PolygonPart>> groups;
  std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (;;) {
    const std::string one(next_geometry(text, at, name));
    if (one.empty()) break;
    const std::size_t line = line_of(text, at - one.size());
    const Geos::Geometry geometry = geos.own(GEOSWKTReader_read_r(geos.handle(), reader.get(), one.c_str()));
    if (!geometry) fail_line(name, line, fmt::format("is not well-known text: {}", geos.message()));
    std::vector<PolygonPart> parts;
    if (!geos.parts(geometry.get(), parts)) {
      fail_line(name, line, "only POLYGON and MULTIPOLYGON make a domain; leave the other geometries out");
    }
    require_finite(parts, line, name);
    if (!parts.empty()) groups.push_back(std::move(parts));
  }
  if (groups.empty()) fail_file(name, "holds no polygon");
  return unite(groups, name);
}

}  // namespace powercell::io
