// Well-known text, with GEOS's reader. A file may contain several geometries; GEOS reads one at a time, so
// the text is split where the parentheses close or after the word EMPTY.
#include <fmt/format.h>

#include <cmath>

#include "apps/io/read/file.hpp"
#include "apps/io/read/geos.hpp"
#include "apps/io/read/polygons.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

constexpr int deepest_brackets = 64;  // GEOS reads collections by recursion

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

// The geometries of a text, one after the other.
class Geometries {
 public:
  Geometries(std::string_view text, const std::string& name) : text_(text), name_(name) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }
  // The text of the next one, without blanks before it; empty at the end.
  std::string_view next();
  const std::string& reference_system() const { return reference_system_; }  // number; empty without one
  [[noreturn]] void fail(const std::string& what) const {                    // names the last geometry
    fail_line(name_, line_of(text_, begin_), what);
  }

 private:
  void skip_blanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n;", at_), text_.size()); }
  void skip_reference_system();
  bool skip_empty();

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0, begin_ = 0;
  std::string reference_system_;
};

// PostGIS writes `SRID=n;` before a geometry. Coordinates may be of any system, but all of the same.
void Geometries::skip_reference_system() {
  if (lower_case(text_.substr(at_, 5)) != "srid=") return;
  const std::size_t end = std::min(text_.find_first_not_of("0123456789", at_ + 5), text_.size());
  const std::string number(text_.substr(at_ + 5, end - at_ - 5));
  if (number.empty() || end == text_.size() || text_[end] != ';')
    fail_line(name_, line_of(text_, at_), "SRID= needs a number and a ';' before the geometry");
  if (!reference_system_.empty() && number != reference_system_) {
    fail_line(name_, line_of(text_, at_),
              fmt::format("SRID {} after a geometry with SRID {}; transform all to one system",
                          number.substr(0, 40), reference_system_.substr(0, 40)));
  }
  reference_system_ = number;
  at_ = end;
  skip_blanks();
}

// Skips the word at `at_`, if there is one; true if it is EMPTY.
bool Geometries::skip_empty() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
  return lower_case(text_.substr(begin, at_ - begin)) == "empty";
}

std::string_view Geometries::next() {
  skip_blanks();
  skip_reference_system();
  begin_ = at_;
  if (at_ == text_.size()) return {};
  int depth = 0;
  while (at_ < text_.size()) {
    // GEOS reads a geometry and ignores the rest of the text, so every end must be found here.
    if (depth == 0 && is_letter(text_[at_])) {
      if (skip_empty()) return text_.substr(begin_, at_ - begin_);
      continue;
    }
    const char c = text_[at_++];
    if (c == '\0') fail_line(name_, line_of(text_, at_), "a NUL byte; is this a text file?");
    if (c == '(' && ++depth > deepest_brackets)
      fail_line(name_, line_of(text_, at_), "parentheses are nested too deeply");
    if (c == ')' && --depth < 0)
      fail_line(name_, line_of(text_, at_), "a parenthesis closes that was not opened");
    if (c == ')' && depth == 0) return text_.substr(begin_, at_ - begin_);
  }
  if (depth != 0) fail("a geometry whose parentheses do not close; the file is truncated");
  fail(fmt::format("is not well-known text: '{}' is followed by neither parentheses nor EMPTY",
                   trimmed(text_.substr(begin_)).substr(0, 40)));
}

void require_finite(const std::vector<PolygonPart>& parts, const Geometries& geometries) {
  const auto check = [&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (!std::isfinite(ring[k][0]) || !std::isfinite(ring[k][1]))
        geometries.fail(fmt::format("point {} of a ring is not finite", k));
    }
  };
  for (const PolygonPart& part : parts) {
    check(part.outer);
    for (const Ring& hole : part.holes) check(hole);
  }
}

}  // namespace

std::vector<PolygonPart> parse_wkt(std::string_view text, const std::string& name, NamedCrs* crs) {
  Geos geos;
  struct Destroy {
    GEOSContextHandle_t handle;
    void operator()(GEOSWKTReader* reader) const { GEOSWKTReader_destroy_r(handle, reader); }
  };
  const std::unique_ptr<GEOSWKTReader, Destroy> reader(GEOSWKTReader_create_r(geos.handle()),
                                                       Destroy{geos.handle()});
  std::vector<std::vector<PolygonPart>> groups;
  Geometries geometries(text, name);
  for (;;) {
    const std::string one(geometries.next());
    if (one.empty()) break;
    const Geos::Geometry geometry = geos.own(GEOSWKTReader_read_r(geos.handle(), reader.get(), one.c_str()));
    if (!geometry) geometries.fail(fmt::format("is not well-known text: {}", geos.message()));
    std::vector<PolygonPart> parts;
    if (!geos.parts(geometry.get(), parts)) {
      geometries.fail("only POLYGON and MULTIPOLYGON make a domain; leave the other geometries out");
    }
    require_finite(parts, geometries);
    if (!parts.empty()) groups.push_back(std::move(parts));
  }
  if (groups.empty()) fail_file(name, "holds no polygon");
  const std::string& number = geometries.reference_system();
  if (crs != nullptr && number.find_first_not_of('0') != std::string::npos) crs->name = "EPSG:" + number;
  return unite(groups, name);
}

}  // namespace powercell::io
