#include "apps/io/tables/wkt_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "apps/io/printable.hpp"
#include "apps/io/read/geos.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/tables/fields.hpp"
#include "apps/io/tables/seeds_columns.hpp"

namespace powercell::io {
namespace {

constexpr const char* wkt_coordinates[] = {"x", "y", "z"};

/// The number of `SRID=n;` in front of a geometry, which is removed; empty without one.
std::string_view take_srid(std::string_view& text) {
  if (lower_case(text.substr(0, 5)) != "srid=") return {};
  const std::size_t end = text.find(';');
  if (end == std::string_view::npos) return {};
  const std::string_view number = trimmed(text.substr(5, end - 5));
  text = trimmed(text.substr(end + 1));
  return number;
}

}  // namespace

bool begins_as_wkt_point(std::string_view text) {
  take_srid(text);
  const std::string begin = lower_case(text.substr(0, 40));
  std::string_view rest(begin);
  if (rest.starts_with("multi")) rest.remove_prefix(5);
  if (!rest.starts_with("point")) return false;
  rest = trimmed(rest.substr(5));
  while (rest.starts_with('z') || rest.starts_with('m')) rest.remove_prefix(1);
  rest = trimmed(rest);
  return rest.starts_with('(') || rest.starts_with("empty");
}

class WktColumn::Parser {
 public:
  Parser() : reader_(GEOSWKTReader_create_r(geos_.handle())) {}
  ~Parser() { GEOSWKTReader_destroy_r(geos_.handle(), reader_); }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  /// Why the text is not a point, or empty; then its coordinates are in `point`.
  std::string parse(const std::string& text, std::array<double, 3>& point) {
    const Geos::Geometry geometry = geos_.own(GEOSWKTReader_read_r(geos_.handle(), reader_, text.c_str()));
    if (!geometry) return fmt::format("not well-known text: {}", geos_.message());
    return geos_.point(geometry.get(), point);
  }

 private:
  Geos geos_;
  GEOSWKTReader* reader_;
};

WktColumn::~WktColumn() = default;

WktColumn::WktColumn(RowSource& rows, std::size_t dimension) : rows_(rows), dimension_(dimension) {
  if (!read_ahead()) return;
  Fields header(ahead_[0].fields.begin(), ahead_[0].fields.end());
  if (!is_header(header)) return;
  if (header.size() == 1 && begins_as_wkt_point(header[0])) {
    ahead_.insert(ahead_.begin(), {{header.begin(), header.end()}, rows.name()});
    ahead_[0].fields[0] = "wkt";
    find_column();
    return;
  }
  rows.begin_rows();
  if (!names_coordinates(header, dimension) && read_ahead()) find_column();
}

bool WktColumn::read_ahead() {
  Fields fields;
  if (!rows_.next(fields)) return false;
  ahead_.push_back({{fields.begin(), fields.end()}, rows_.place()});
  return true;
}

void WktColumn::find_column() {
  const std::vector<std::string>&header = ahead_[0].fields, &first = ahead_[1].fields;
  for (column_ = 0; column_ < first.size() && !begins_as_wkt_point(first[column_]); ++column_) {
  }
  if (column_ >= std::min(header.size(), first.size())) return;
  geometry_ = fmt::format("the points of '{}'", readable(header[column_]));
  parser_ = std::make_unique<Parser>();
}

bool WktColumn::next(Fields& fields) {
  if (passed_ < ahead_.size()) {
    fields.assign(ahead_[passed_].fields.begin(), ahead_[passed_].fields.end());
    ++passed_;
  } else if (!rows_.next(fields)) {
    return false;
  } else {
    passed_ = ahead_.size() + 1;
  }
  if (parser_) add_coordinates(fields);
  return true;
}

std::string WktColumn::place() const {
  return passed_ > 0 && passed_ <= ahead_.size() ? ahead_[passed_ - 1].place : rows_.place();
}

void WktColumn::add_coordinates(Fields& fields) {
  if (passed_ == 1) {
    fields.insert(fields.begin(), wkt_coordinates, wkt_coordinates + dimension_);
    return;
  }
  if (column_ >= fields.size()) fail("the row is too short: it has no " + geometry_);
  std::string_view text = fields[column_];
  const std::string_view srid = take_srid(text);
  const std::string crs =
      srid.find_first_not_of('0') == std::string_view::npos ? "" : fmt::format("EPSG:{}", srid);
  if (passed_ == 2) crs_.name = crs;
  if (crs != crs_.name)
    fail(fmt::format("the point is in '{}', the ones before in '{}'; transform all to one system",
                     readable(crs), readable(crs_.name)));
  std::array<double, 3> point{};
  const std::string fault = parser_->parse(std::string(text), point);
  if (!fault.empty()) fail(fmt::format("'{}' is {}", readable(std::string(text.substr(0, 60))), fault));
  for (std::size_t k = 0; k < dimension_; ++k) coordinates_[k] = fmt::format("{}", point[k]);
  fields.insert(fields.begin(), coordinates_.begin(),
                coordinates_.begin() + static_cast<std::ptrdiff_t>(dimension_));
}

}  // namespace powercell::io
