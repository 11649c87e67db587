#include "apps/io/tables/seeds_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <span>
#include <string_view>

#include "apps/io/closest.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/tables/column_units.hpp"
#include "apps/io/tables/fields.hpp"

namespace powercell::io {
namespace {

using Names = std::span<const std::string_view>;

constexpr std::string_view longitude_names[] = {"lon", "long", "longitude", "lng", "decimallongitude"};
constexpr std::string_view latitude_names[] = {"lat", "latitude", "decimallatitude"};
constexpr std::string_view x_names[] = {"lon", "long", "longitude", "lng", "decimallongitude", "easting"};
constexpr std::string_view y_names[] = {"lat", "latitude", "decimallatitude", "northing"};
constexpr std::string_view weight_names[] = {"w", "weight", "weights"};
constexpr std::string_view radius_names[] = {"r", "radius", "radii"};
constexpr std::string_view diameter_names[] = {"diameter", "diameters", "diam"};
/// Names of columns that are not coordinates; "" is that of row numbers.
constexpr std::string_view other_names[] = {"",     "id",    "fid",  "gid",    "objectid", "index", "key",
                                            "name", "label", "seed", "status", "mass",     "area"};

/// Words that may stand beside x, y or z in the name of a coordinate: x_coord, "pos x [mm]", POINT_X.
constexpr std::string_view coordinate_words[] = {
    "coord",    "coords", "coordinate", "pos", "position", "point", "center", "centre", "centroid", "loc",
    "location", "m",      "mm",         "cm",  "km",       "um",    "nm",     "ft",     "px"};

bool is_one_of(std::string_view name, Names known) {
  return std::find(known.begin(), known.end(), name) != known.end();
}

/// The words of a name in lower case; marks separate them.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// Whether a name is that of an axis with words that may stand beside it: xcoord, x_coord, "x (m)".
bool is_axis(std::string_view name, std::string_view axis) {
  bool found = false;
  for (const std::string& word : words_of(name)) {
    const bool joined =
        word.size() > 1 && (is_one_of(word.substr(1), coordinate_words) && word.starts_with(axis));
    if ((word == axis || joined) && !found)
      found = true;
    else if (!is_one_of(word, coordinate_words))
      return false;
  }
  return found;
}

bool has_map_name(const ColumnHeading& heading, Names known) {
  return is_one_of(heading.name, known) && !heading.is(ColumnHeading::Unit::other);  // "lon (rad)"
}

bool says_degrees(const ColumnHeading& heading, Names known) {
  return is_one_of(heading.name, known) &&
         (heading.is(ColumnHeading::Unit::none) || heading.is(ColumnHeading::Unit::degree));
}

std::string row_names(std::size_t dimension) {
  return dimension == 2 ? "x, y, weight" : "x, y, z, weight";
}

/// Finds the columns of one table.
class Chooser {
 public:
  Chooser(const RowSource& rows, std::size_t count, std::size_t dimension, const ColumnChoice& choice)
      : rows_(rows), dimension_(dimension), choice_(choice) {
    columns_.count = count;
  }

  SeedColumns by_header(const Fields& header) {
    for (const std::string_view field : header) {
      columns_.names.emplace_back(field);
      names_.push_back(column_name(field));
      headings_.push_back(column_heading(field));
    }
    const bool chosen = choose();
    columns_.named = !chosen && (!rows_.geometry().empty() || find_coordinates());
    const bool named = chosen || columns_.named;
    if (!columns_.weight) find_weight();
    if (!named) take_by_order();
    finish(named);
    check_units();
    return std::move(columns_);
  }

  SeedColumns by_order() {
    if (!choose()) take_by_order();
    finish(true);
    if (!choice_.any()) columns_.note.clear();  // the usual rows
    return std::move(columns_);
  }

 private:
  /// Takes the columns that the user chose; whether the coordinates are among them.
  bool choose() {
    std::size_t found = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto column = chosen(choice_.position[axis]);
      if (!column) continue;
      if (axis >= dimension_)
        rows_.fail("--z-column is given, but the seeds of this domain have 2 coordinates; leave it out");
      columns_.position[axis] = *column;
      ++found;
    }
    if (found != 0 && found != dimension_)
      rows_.fail(fmt::format("only {} of the {} coordinates of a seed is chosen; give {} together", found,
                             dimension_, position_options()));
    if (!choice_.weight.empty() && !choice_.radius.empty())
      rows_.fail("--weight-column and --radius-column are both given; a weight comes from one of them");
    columns_.radius = !choice_.radius.empty();
    columns_.weight = chosen(columns_.radius ? choice_.radius : choice_.weight);
    columns_.id = chosen(choice_.id);
    return found != 0;
  }

  std::optional<std::size_t> chosen(const std::string& wanted) const {
    if (wanted.empty()) return std::nullopt;
    const std::string name = column_name(wanted);
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (columns_.names[k] == wanted) return k;
      if (names_[k] != name) continue;
      if (found) rows_.fail(fmt::format("several columns are named '{}'; rename one", readable(wanted)));
      found = k;
    }
    if (found) return found;
    std::size_t number = 0;
    const auto [end, code] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
    if (code == std::errc() && end == wanted.data() + wanted.size() && number >= 1 &&
        number <= columns_.count)
      return number - 1;
    if (names_.empty())
      rows_.fail(fmt::format("no column '{}': the table has no header; give a number from 1 to {}",
                             readable(wanted), columns_.count));
    std::string all;
    for (std::size_t k = 0; k < names_.size() && k < 12; ++k) all += (k > 0 ? ", " : "") + shown(k);
    rows_.fail(fmt::format("no column '{}'; the header has {}{}{}", readable(wanted), all,
                           names_.size() > 12 ? fmt::format(" and {} more", names_.size() - 12) : "",
                           did_you_mean(closest(wanted, columns_.names))));
  }

  /// The only column that is so, if any.
  template <class Is>
  std::optional<std::size_t> only(const Is& is) const {
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (!is(k)) continue;
      if (found) fail_twice(*found, k);
      found = k;
    }
    return found;
  }

  /// The column with one of these names, if any.
  std::optional<std::size_t> find(Names known) const {
    return only([&](std::size_t k) { return is_one_of(names_[k], known); });
  }

  /// The same, or else with one of these names and a unit.
  std::optional<std::size_t> find_with_unit(Names known) const {
    if (const auto plain = find(known)) return plain;
    return only([&](std::size_t k) { return is_one_of(headings_[k].name, known); });
  }

  std::optional<std::size_t> find_on_map(Names known) const {
    if (const auto plain = find(known)) return plain;
    return only([&](std::size_t k) { return has_map_name(headings_[k], known); });
  }

  std::optional<std::size_t> find_axis(std::size_t axis) const {
    if (axis >= dimension_) return find_with_unit({&axis_names[axis], 1});
    return only([&](std::size_t k) { return is_axis(headings_[k].name, axis_names[axis]); });
  }

  /// Takes the column of weights, if there is one. Radii and diameters are none, but are not ignored either.
  void find_weight() {
    columns_.weight = find_with_unit(weight_names);
    if (columns_.weight) {
      const ColumnHeading& heading = headings_[*columns_.weight];
      if (!heading.is(ColumnHeading::Unit::none) && !heading.is(ColumnHeading::Unit::area))
        rows_.fail(fmt::format(
            "a weight is a length squared, but the unit of the column {0} is none; give "
            "--weight-column {1} to take its numbers as they are{2} (or rename this column "
            "if it is not the weight of a cell)",
            shown(*columns_.weight), option_value(*columns_.weight),
            heading.is(ColumnHeading::Unit::length)
                ? fmt::format(", or --radius-column {} to use their squares", option_value(*columns_.weight))
                : ""));
      return;
    }
    if (const auto radius = find_with_unit(radius_names))
      rows_.fail(fmt::format(
          "the header has a column {} and no column of weights; a weight is a length squared: give "
          "--radius-column {} to use the squares (or rename this column if it is not a radius)",
          shown(*radius), option_value(*radius)));
    if (const auto diameter = find_with_unit(diameter_names))
      rows_.fail(fmt::format(
          "the header has a column {} and no column of weights; the weight of a disc or ball is its radius "
          "squared: add a column of half the diameters, and name it with --radius-column (or rename this "
          "column if it is not a diameter)",
          shown(*diameter)));
  }

  /// Refuses units that contradict each other, since numbers are taken as they are.
  void check_units() const {
    using Unit = ColumnHeading::Unit;
    std::optional<std::size_t> first;
    for (std::size_t axis = 0; axis < dimension_ && !is_geometry(); ++axis) {
      const std::size_t k = columns_.position[axis];
      if (!headings_[k].is(Unit::length) && !headings_[k].is(Unit::degree)) continue;
      if (first && headings_[*first].unit != headings_[k].unit) fail_units(shown(*first), k);
      if (!first) first = k;
    }
    if (!columns_.weight) return;
    const ColumnHeading& weight = headings_[*columns_.weight];
    if (columns_.radius && weight.is(Unit::area))
      rows_.fail(fmt::format("{} has areas, not radii; give --weight-column {} to take them as weights",
                             shown(*columns_.weight), option_value(*columns_.weight)));
    if (!weight.is(columns_.radius ? Unit::length : Unit::area)) return;
    if (columns_.degrees && weight.unit != "m")
      rows_.fail(
          fmt::format("longitudes and latitudes are projected to a plane in metres, but {} is in "
                      "another unit; write it in metres, and rename the column",
                      shown(*columns_.weight)));
    if (first && headings_[*first].is(Unit::length) && headings_[*first].unit != weight.unit)
      fail_units(shown(*first), *columns_.weight);
  }

  [[noreturn]] void fail_units(const std::string& first, std::size_t second) const {
    rows_.fail(
        fmt::format("the columns {} and {} have different units, and numbers are not converted; write "
                    "both in one unit, and rename the column",
                    first, shown(second)));
  }

  /// As an argument of an option in a shell.
  std::string option_value(std::size_t column) const {
    const std::string& name = columns_.names[column];
    const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    });
    if (plain) return name;
    return name.find('\'') == std::string::npos ? shown(column) : fmt::format("{}", column + 1);
  }

  [[noreturn]] void fail_twice(std::size_t first, std::size_t second) const {
    rows_.fail(
        fmt::format("the header has columns {} and {}, which mean the same; rename one, or choose with "
                    "--x-column and so on",
                    shown(first), shown(second)));
  }

  /// By x, y, z, or else by the names used for maps. False if there is neither.
  bool find_coordinates() {
    std::array<std::optional<std::size_t>, 3> found;
    for (std::size_t axis = 0; axis < 3; ++axis) found[axis] = find({&axis_names[axis], 1});
    if (!found[0] && !found[1] && !found[2])
      found = {find_on_map(x_names), find_on_map(y_names), std::nullopt};
    if (!found[0] && !found[1] && !found[2])
      for (std::size_t axis = 0; axis < 3; ++axis) found[axis] = find_axis(axis);
    if (!found[0] && !found[1] && !found[2]) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (found[axis].has_value() != (axis < dimension_))
        rows_.fail(fmt::format(
            "the header names some of x, y, z, but seeds of this domain have {} coordinates; name their "
            "columns {}, and rename others",
            dimension_, row_names(dimension_)));
      columns_.position[axis] = found[axis].value_or(axis);
    }
    return true;
  }

  void take_by_order() {
    if (!names_.empty() && (columns_.weight || find_any(other_names)))
      rows_.fail(
          fmt::format("the header names no coordinates; name their columns {}, or choose them with "
                      "--x-column and so on{}",
                      row_names(dimension_), separated_by(rows_.separator())));
    if (columns_.weight.value_or(dimension_) < dimension_ || columns_.id.value_or(dimension_) < dimension_)
      rows_.fail(fmt::format("the first {} columns are the coordinates unless others are chosen; give {} too",
                             dimension_, position_options()));
    if (columns_.weight) return;
    if (columns_.count == dimension_ + 1 && columns_.id != dimension_)
      columns_.weight = dimension_;
    else if (columns_.count != dimension_ && !columns_.id)
      rows_.fail(fmt::format(
          "{} columns, but a row of this domain's seeds is {}{}; other tables need a "
          "header with {}, or --x-column 2 and so on",
          columns_.count, seed_row(dimension_), separated_by(rows_.separator()), row_names(dimension_)));
  }

  const char* position_options() const {
    return dimension_ == 2 ? "--x-column and --y-column" : "--x-column, --y-column and --z-column";
  }

  bool find_any(Names known) const {
    return std::any_of(headings_.begin(), headings_.end(),
                       [&](const ColumnHeading& heading) { return is_one_of(heading.name, known); });
  }

  void finish(bool named) {
    const auto& p = columns_.position;
    for (std::size_t axis = 0; axis < dimension_; ++axis) {
      if (p[axis] >= columns_.count) rows_.fail(fmt::format("there is no column {}", p[axis] + 1));
      if (!is_geometry()) columns_.taken += fmt::format("{} from {}, ", axis_names[axis], shown(p[axis]));
    }
    if (is_geometry()) columns_.taken = fmt::format("positions from {}, ", rows_.geometry());
    columns_.taken += columns_.weight ? "weight from " + shown(*columns_.weight) : "no weights";
    if (columns_.radius) columns_.taken += " squared";
    // In either order: --x-column lat takes a header whose names are swapped.
    const auto are = [&](std::size_t longitude, std::size_t latitude) {
      return says_degrees(headings_[longitude], longitude_names) &&
             says_degrees(headings_[latitude], latitude_names);
    };
    columns_.degrees = !headings_.empty() && (are(p[0], p[1]) || are(p[1], p[0]));
    columns_.note = note(named);
  }

  std::string note(bool named) const {
    std::string kept;
    std::size_t others = 0;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (names_[k].empty() || is_used(k) || ++others > 5) continue;
      kept += (others > 1 ? ", " : "") + shown(k);
    }
    if (named && others == 0 && columns_.weight && !choice_.any() && has_plain_names()) return {};
    if (others > 5) kept += fmt::format(" and {} more", others - 5);
    return fmt::format("seeds: {}{}{}", columns_.taken, named ? "" : " (by their order)",
                       others > 0 ? (choice_.keeps_others ? "; kept: " : "; left out: ") + kept : "");
  }

  bool is_geometry() const { return columns_.named && !rows_.geometry().empty(); }

  bool has_plain_names() const {
    for (std::size_t axis = 0; axis < dimension_ && !names_.empty(); ++axis)
      if (names_[columns_.position[axis]] != axis_names[axis]) return false;
    return true;
  }

  bool is_used(std::size_t column) const {
    const auto end = columns_.position.begin() + static_cast<std::ptrdiff_t>(dimension_);
    return columns_.weight == column || columns_.id == column ||
           std::find(columns_.position.begin(), end, column) != end;
  }

  std::string shown(std::size_t column) const {
    if (names_.empty()) return fmt::format("column {}", column + 1);
    return fmt::format("'{}'", readable(columns_.names[column]));
  }

  const RowSource& rows_;
  std::size_t dimension_;
  const ColumnChoice& choice_;
  std::vector<std::string> names_;       // in lower case
  std::vector<ColumnHeading> headings_;  // the same without units
  SeedColumns columns_;
};

}  // namespace

SeedColumns columns_by_header(const RowSource& rows, const Fields& header, std::size_t dimension,
                              const ColumnChoice& choice) {
  return Chooser(rows, header.size(), dimension, choice).by_header(header);
}

SeedColumns columns_by_order(const RowSource& rows, std::size_t count, std::size_t dimension,
                             const ColumnChoice& choice) {
  return Chooser(rows, count, dimension, choice).by_order();
}

bool names_coordinates(const Fields& header, std::size_t dimension) {
  return std::any_of(header.begin(), header.end(), [&](std::string_view field) {
    const ColumnHeading heading = column_heading(field);
    bool is_named = has_map_name(heading, x_names) || has_map_name(heading, y_names);
    for (std::size_t axis = 0; axis < dimension; ++axis)
      is_named = is_named || is_axis(heading.name, axis_names[axis]);
    return is_named;
  });
}

bool is_weight_name(std::string_view name) {
  const ColumnHeading heading = column_heading(name);
  return is_one_of(heading.name, weight_names) &&
         (heading.is(ColumnHeading::Unit::none) || heading.is(ColumnHeading::Unit::area));
}

std::string seed_row(std::size_t dimension) {
  return dimension == 2 ? "`x y` or `x y weight`" : "`x y z` or `x y z weight`";
}

}  // namespace powercell::io
