// Seeds from rows of fields: text, CSV, features of maps.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "apps/io/printable.hpp"
#include "apps/io/read_fields.hpp"
#include "apps/io/read_file.hpp"
#include "apps/io/read_seeds.hpp"
#include "apps/io/read_text.hpp"
#include "apps/io/seeds_columns.hpp"
#include "apps/io/wkt_column.hpp"

namespace powercell::io {
namespace {

constexpr char comment = '#';

class SeedsReader {
 public:
  SeedsReader(RowSource& rows, int dimension, const ColumnChoice& choice)
      : rows_(rows),
        dimension_(static_cast<std::size_t>(dimension)),
        choice_(choice),
        numbers_(rows.separator()) {
    table_.dimension = dimension;
  }
  SeedTable read();

 private:
  bool first_line(const Fields& fields);
  void row(Fields& fields);
  double number(std::string_view field, std::size_t column);
  double weight(const Fields& fields);
  void finish_columns();
  std::string shown(std::size_t column) const;
  void require_different_ids() const;
  [[noreturn]] void fail_width(std::size_t columns) const;

  RowSource& rows_;
  std::size_t dimension_;
  const ColumnChoice& choice_;
  FieldNumbers numbers_;
  SeedTable table_;
  std::optional<std::uint64_t> announced_;  // by a count line
  std::string announced_place_;
  std::optional<SeedColumns> columns_;
  bool header_ = false;
};

std::string SeedsReader::shown(std::size_t column) const {
  if (rows_.separator() == '\0') return fmt::format("'{}'", readable(columns_->names[column]));
  return fmt::format("column {}", column + 1);
}

double SeedsReader::number(std::string_view field, std::size_t column) {
  double value = 0;
  const Parsed parsed = numbers_.read(field, value);
  if (parsed == Parsed::ok) return value;
  const std::string what =
      fmt::format("{}: seed {} (from 0), {}: {}", rows_.place(), table_.count(), shown(column),
                  field.empty() ? "is empty" : numbers_.why_not(field, parsed));
  if (parsed == Parsed::not_a_number)
    throw Error(ErrorCode::invalid_file,
                what + fmt::format("; a row is {}{}", seed_row(dimension_), separated_by(rows_.separator())));
  throw Error(ErrorCode::invalid_seed, what + "; remove the seed or give it a finite value");
}

// Whether the first line is a header or a count rather than a row.
bool SeedsReader::first_line(const Fields& fields) {
  if (is_header(fields)) {
    columns_ = columns_by_header(rows_, fields, dimension_, choice_);
    header_ = true;
    table_.text.columns = fields.size();
    table_.text.separator = rows_.separator() == '\0' ? ',' : rows_.separator();
    rows_.begin_rows();
    return true;
  }
  double value = 0;
  if (fields.size() == 1 && parse_number(fields[0], value) == Parsed::ok && value >= 0 &&
      value == static_cast<double>(static_cast<std::uint64_t>(std::min(value, 1e18)))) {
    announced_ = static_cast<std::uint64_t>(value);
    announced_place_ = rows_.place();
    return true;
  }
  return false;
}

void SeedsReader::fail_width(std::size_t columns) const {
  rows_.fail(fmt::format("seed {} (from 0) has {} columns, {} {}; give every row a weight or none{}",
                         table_.count(), columns,
                         header_ && table_.count() == 0 ? "the header has" : "the rows before have",
                         columns_->count, separated_by(rows_.separator())));
}

void SeedsReader::row(Fields& fields) {
  if (!header_ && rows_.separator() == '\t') {  // tabs at the ends of lines, as some programs print
    while (fields.back().empty()) fields.pop_back();
    fields.erase(fields.begin(), std::find_if(fields.begin(), fields.end(),
                                              [](std::string_view field) { return !field.empty(); }));
  }
  if (!columns_) columns_ = columns_by_order(rows_, fields.size(), dimension_, choice_);
  if (fields.size() != columns_->count) fail_width(fields.size());
  for (std::size_t axis = 0; axis < dimension_; ++axis) {
    const std::size_t column = columns_->position[axis];
    table_.positions.push_back(number(fields[column], column));
  }
  table_.weights.push_back(weight(fields));
  if (header_)
    for (const std::string_view field : fields) table_.text.add(field);
}

double SeedsReader::weight(const Fields& fields) {
  if (!columns_->weight) return 0;
  const std::size_t column = *columns_->weight;
  const double value = number(fields[column], column);
  if (!columns_->radius) return value;
  if (value < 0)
    rows_.fail(fmt::format("seed {} (from 0), {}: the radius is {}; give one of at least 0", table_.count(),
                           shown(column), value));
  return value * value;
}

void SeedsReader::require_different_ids() const {
  if (!table_.columns.id || !header_) return;
  std::unordered_map<std::string_view, std::size_t> seed_of;
  for (std::size_t i = 0; i < table_.count(); ++i) {
    const std::string_view id = table_.text.field(i, *table_.columns.id);
    const auto [first, is_new] = seed_of.emplace(id, i);
    if (!is_new)
      fail_file(rows_.name(),
                fmt::format("seeds {} and {} (from 0) have the same id '{}'; make ids different, or "
                            "leave --id-column out",
                            first->second, i, id));
  }
}

void SeedsReader::finish_columns() {
  if (numbers_.mark() == ',')
    columns_->note = (columns_->note.empty() ? "seeds: " : columns_->note + "; ") + "decimal commas";
  table_.text.mark = numbers_.mark();
  table_.columns = std::move(*columns_);
}

SeedTable SeedsReader::read() {
  Fields fields;
  for (bool first = true; rows_.next(fields); first = false)
    if (!first || !first_line(fields)) row(fields);
  if (announced_ && *announced_ != table_.count()) {
    fail_file(
        announced_place_,
        fmt::format("{} seeds are announced, but the file has {}; it is truncated or the count is wrong",
                    *announced_, table_.count()));
  }
  if (columns_) finish_columns();
  require_different_ids();
  return std::move(table_);
}

}  // namespace

SeedTable parse_seed_rows(RowSource& rows, int dimension, const ColumnChoice& choice) {
  return SeedsReader(rows, dimension, choice).read();
}

SeedTable parse_seeds_text(std::string_view text, int dimension, const std::string& name,
                           const ColumnChoice& choice) {
  if (text.substr(0, 4096).find('\0') != std::string_view::npos)
    fail_line(name, 1, "has NUL bytes; is it text? (.npy files need that extension)");
  const char separator = begins_as_wkt_point(trimmed(text)) ? '\0' : number_separator(text, comment);
  Records records(text, name, separator, comment);
  if (choice.has_position()) return parse_seed_rows(records, dimension, choice);
  WktColumn rows(records, static_cast<std::size_t>(dimension));
  SeedTable table = parse_seed_rows(rows, dimension, choice);
  table.columns.crs = rows.crs().name;
  return table;
}

}  // namespace powercell::io
