#include "apps/io/seeds_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

using Names = std::span<const std::string_view>;

constexpr std::string_view x_names[] = {"lon", "long", "longitude", "lng", "easting"};
constexpr std::string_view y_names[] = {"lat", "latitude", "northing"};
constexpr std::string_view weight_names[] = {"w", "weight", "weights"};
constexpr std::string_view radius_names[] = {"r", "radius", "radii"};
/// Names of columns that are not coordinates; "" is that of row numbers.
constexpr std::string_view other_names[] = {"",     "id",    "fid",  "gid",    "objectid", "index", "key",
                                            "name", "label", "seed", "status", "mass",     "area"};
constexpr const char* axis_names = "xyz";

std::string row_names(std::size_t dimension) {
  return dimension == 2 ? "x, y, weight" : "x, y, z, weight";
}

class Header {
 public:
  Header(const Records& records, const Fields& fields, std::size_t dimension)
      : records_(records), dimension_(dimension) {
    for (const std::string_view field : fields) names_.push_back(column_name(field));
  }

  SeedColumns columns() {
    const bool by_name = find_coordinates();
    columns_.count = names_.size();
    columns_.weight = find(weight_names);
    if (!by_name) take_by_order();
    if (const auto radius = find(radius_names); radius && !columns_.weight)
      records_.fail(fmt::format(
          "the header has a column {} and no column of weights; a weight is a length "
          "squared: add a column weight with the squared radii (or rename this column if it is not a radius)",
          quoted(*radius)));
    columns_.note = note(by_name);
    return columns_;
  }

 private:
  /// The column with one of these names, if any.
  std::optional<std::size_t> find(Names known) const {
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (std::find(known.begin(), known.end(), names_[k]) == known.end()) continue;
      if (found)
        records_.fail(fmt::format("the header has columns {} and {}, which mean the same; rename one",
                                  quoted(*found), quoted(k)));
      found = k;
    }
    return found;
  }

  /// By x, y, z, or else by the names used for maps. False if there is neither.
  bool find_coordinates() {
    std::array<std::optional<std::size_t>, 3> found;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string_view name(axis_names + axis, 1);
      found[axis] = find({&name, 1});
    }
    if (!found[0] && !found[1] && !found[2]) found = {find(x_names), find(y_names), std::nullopt};
    if (!found[0] && !found[1] && !found[2]) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (found[axis].has_value() != (axis < dimension_))
        records_.fail(fmt::format(
            "the header names some of x, y, z, but seeds of this domain have {} coordinates; name their "
            "columns {}, and rename others",
            dimension_, row_names(dimension_)));
      columns_.position[axis] = found[axis].value_or(axis);
    }
    return true;
  }

  void take_by_order() {
    if (columns_.weight || find_any(other_names))
      records_.fail(fmt::format("the header names no coordinates; name their columns {}{}",
                                row_names(dimension_), separated_by(records_.separator())));
    columns_ = columns_by_order(records_, names_.size(), dimension_);
  }

  bool find_any(Names known) const {
    return std::find_first_of(names_.begin(), names_.end(), known.begin(), known.end()) != names_.end();
  }

  std::string note(bool by_name) const {
    std::string used, unused;
    for (std::size_t axis = 0; axis < dimension_; ++axis)
      used += fmt::format("{} from {}, ", axis_names[axis], quoted(columns_.position[axis]));
    used += columns_.weight ? "weight from " + quoted(*columns_.weight) : "no weights";
    std::size_t others = 0;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (names_[k].empty() || is_used(k) || ++others > 5) continue;
      unused += (others > 1 ? ", " : "") + quoted(k);
    }
    if (by_name && others == 0 && columns_.weight) return {};
    if (others > 5) unused += fmt::format(" and {} more", others - 5);
    return fmt::format("seeds: {}{}{}", used, by_name ? "" : " (by their order)",
                       others > 0 ? "; not used: " + unused : "");
  }

  bool is_used(std::size_t column) const {
    const auto end = columns_.position.begin() + static_cast<std::ptrdiff_t>(dimension_);
    return columns_.weight == column || std::find(columns_.position.begin(), end, column) != end;
  }

  std::string quoted(std::size_t column) const { return fmt::format("'{}'", readable(names_[column])); }

  const Records& records_;
  std::size_t dimension_;
  std::vector<std::string> names_;
  SeedColumns columns_;
};

}  // namespace

SeedColumns columns_by_header(const Records& records, const Fields& header, std::size_t dimension) {
  return Header(records, header, dimension).columns();
}

SeedColumns columns_by_order(const Records& records, std::size_t count, std::size_t dimension) {
  SeedColumns columns;
  columns.count = count;
  if (count == dimension + 1)
    columns.weight = dimension;
  else if (count != dimension)
    records.fail(fmt::format(
        "{} columns, but a row of this domain's seeds is {}{}; other tables need a header with {}", count,
        seed_row(dimension), separated_by(records.separator()), row_names(dimension)));
  return columns;
}

std::string seed_row(std::size_t dimension) {
  return dimension == 2 ? "`x y` or `x y weight`" : "`x y z` or `x y z weight`";
}

}  // namespace powercell::io
