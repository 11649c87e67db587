// Seeds from rows of fields: text, CSV, features of maps.
#include "apps/io/tables/seeds_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <utility>

#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/foreign_files.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/tables/fields.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "apps/io/tables/seeds_columns.hpp"
#include "apps/io/tables/wkt_column.hpp"

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
  /// Reads the next seed.
  /// \return whether there is one
  bool next();
  const std::array<double, 3>& position() const { return position_; }
  double weight() const { return weight_; }
  std::size_t dimension() const { return dimension_; }
  /// Null before the first seed.
  const SeedColumns* columns() const { return columns_ ? &*columns_ : nullptr; }
  SeedTable read();

 private:
  bool first_line(const Fields& fields);
  void row(Fields& fields);
  double number(std::string_view field, std::size_t column);
  double weight_of(const Fields& fields);
  void finish_columns();
  std::string shown(std::size_t column) const;
  void require_different_ids() const;
  [[noreturn]] void fail_width(std::size_t columns) const;

  RowSource& rows_;
  std::size_t dimension_;
  const ColumnChoice& choice_;
  FieldNumbers numbers_;
  SeedTable table_;  // without its seeds until read()
  Fields fields_;    // of the present row
  std::array<double, 3> position_{};
  double weight_ = 0;
  std::size_t count_ = 0;  // of seeds so far
  bool begun_ = false;
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
  const std::string what = fmt::format("{}: seed {} (from 0), {}: {}", rows_.place(), count_, shown(column),
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
  rows_.fail(fmt::format("seed {} (from 0) has {} columns, {} {}; give every row a weight or none{}{}",
                         count_, columns, header_ && count_ == 0 ? "the header has" : "the rows before have",
                         columns_->count, separated_by(rows_.separator()),
                         header_ && count_ == 0 ? "; if the first line is a title, begin it with #" : ""));
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
    position_[axis] = number(fields[column], column);
  }
  weight_ = weight_of(fields);
}

double SeedsReader::weight_of(const Fields& fields) {
  if (!columns_->weight) return 0;
  const std::size_t column = *columns_->weight;
  const double value = number(fields[column], column);
  if (!columns_->radius) return value;
  if (value < 0)
    rows_.fail(fmt::format("seed {} (from 0), {}: the radius is {}; give one of at least 0", count_,
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

bool SeedsReader::next() {
  bool found = rows_.next(fields_);
  if (found && !std::exchange(begun_, true) && first_line(fields_)) found = rows_.next(fields_);
  if (found) {
    row(fields_);
    ++count_;
    return true;
  }
  if (announced_ && *announced_ != count_)
    fail_file(
        announced_place_,
        fmt::format("{} seeds are announced, but the file has {}; it is truncated or the count is wrong",
                    *announced_, count_));
  return false;
}

SeedTable SeedsReader::read() {
  while (next()) {
    table_.positions.insert(table_.positions.end(), position_.begin(),
                            position_.begin() + static_cast<std::ptrdiff_t>(dimension_));
    table_.weights.push_back(weight_);
    if (header_)
      for (const std::string_view field : fields_) table_.text.add(field);
  }
  if (columns_) finish_columns();
  require_different_ids();
  return std::move(table_);
}

/// The rows of a text.
Records records_of(std::string_view text, const std::string& name) {
  if (text.substr(0, 4096).find('\0') != std::string_view::npos)
    fail_line(name, 1, "has NUL bytes; is it text? (.npy files need that extension)");
  refuse_foreign_seeds(text, name);
  return {text, name, begins_as_wkt_point(trimmed(text)) ? '\0' : number_separator(text, comment), comment};
}

}  // namespace

SeedTable parse_seed_rows(RowSource& rows, int dimension, const ColumnChoice& choice) {
  return SeedsReader(rows, dimension, choice).read();
}

SeedTable parse_seeds_text(std::string_view text, int dimension, const std::string& name,
                           const ColumnChoice& choice) {
  Records records = records_of(text, name);
  if (choice.has_position()) return parse_seed_rows(records, dimension, choice);
  WktColumn rows(records, static_cast<std::size_t>(dimension));
  SeedTable table = parse_seed_rows(rows, dimension, choice);
  table.columns.crs = rows.crs().name;
  return table;
}

struct SeedText::Rows {
  Rows() = default;
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;
  virtual ~Rows() = default;
  virtual bool next(double* position, double& weight) = 0;
  virtual SeedColumns columns() const = 0;
};

namespace {

class TextRows : public SeedText::Rows {
 public:
  TextRows(std::string_view text, int dimension, const std::string& name, const ColumnChoice& choice)
      : records_(records_of(text, name)),
        points_(records_, static_cast<std::size_t>(dimension)),
        reader_(choice.has_position() ? static_cast<RowSource&>(records_) : points_, dimension, choice) {}

  bool next(double* position, double& weight) override {
    if (!reader_.next()) return false;
    std::copy_n(reader_.position().begin(), reader_.dimension(), position);
    weight = reader_.weight();
    return true;
  }
  SeedColumns columns() const override {
    const SeedColumns* const found = reader_.columns();
    SeedColumns columns = found ? *found : SeedColumns();
    columns.crs = points_.crs().name;
    return columns;
  }

 private:
  Records records_;
  WktColumn points_;
  SeedsReader reader_;
};

}  // namespace

SeedText::SeedText(std::string_view text, int dimension, const std::string& name, const ColumnChoice& choice)
    : rows_(std::make_unique<TextRows>(text, dimension, name, choice)) {}

SeedText::~SeedText() = default;

bool SeedText::next(double* position, double& weight) {
  return rows_->next(position, weight);
}

SeedColumns SeedText::columns() const {
  return rows_->columns();
}

}  // namespace powercell::io
