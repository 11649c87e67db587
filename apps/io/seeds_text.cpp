// Seeds as text or CSV.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "apps/io/read_fields.hpp"
#include "apps/io/read_file.hpp"
#include "apps/io/read_seeds.hpp"
#include "apps/io/read_text.hpp"
#include "apps/io/seeds_columns.hpp"

namespace powercell::io {
namespace {

constexpr char comment = '#';

class SeedsText {
 public:
  SeedsText(std::string_view text, int dimension, const std::string& name, const ColumnChoice& choice)
      : records_(text, name, number_separator(text, comment), comment),
        dimension_(static_cast<std::size_t>(dimension)),
        choice_(choice) {
    table_.dimension = dimension;
  }
  SeedTable read();

 private:
  bool first_line(const Fields& fields);
  void row(Fields& fields);
  double number(std::string_view field, std::size_t column) const;
  double weight(const Fields& fields) const;
  void require_different_ids() const;
  [[noreturn]] void fail_width(std::size_t columns) const;

  Records records_;
  std::size_t dimension_;
  const ColumnChoice& choice_;
  SeedTable table_;
  std::optional<std::uint64_t> announced_;  // by a count line
  std::size_t announced_line_ = 0;
  std::optional<SeedColumns> columns_;
  bool header_ = false;
};

double SeedsText::number(std::string_view field, std::size_t column) const {
  double value = 0;
  const Parsed parsed = parse_number(field, value);
  if (parsed == Parsed::ok) return value;
  const std::string what =
      fmt::format("{}:{}: seed {} (from 0), column {}: {}", records_.name(), records_.line(), table_.count(),
                  column + 1, field.empty() ? "is empty" : why_not(field, parsed));
  if (parsed == Parsed::not_a_number)
    throw Error(ErrorCode::invalid_file, what + fmt::format("; a row is {}{}", seed_row(dimension_),
                                                            separated_by(records_.separator())));
  throw Error(ErrorCode::invalid_seed, what + "; remove the seed or give it a finite value");
}

// Whether the first line is a header or a count rather than a row.
bool SeedsText::first_line(const Fields& fields) {
  if (is_header(fields)) {
    columns_ = columns_by_header(records_, fields, dimension_, choice_);
    header_ = true;
    table_.text.columns = fields.size();
    table_.text.separator = records_.separator();
    if (records_.separator() != ' ') records_.comment_whole_lines();
    return true;
  }
  double value = 0;
  if (fields.size() == 1 && parse_number(fields[0], value) == Parsed::ok && value >= 0 &&
      value == static_cast<double>(static_cast<std::uint64_t>(std::min(value, 1e18)))) {
    announced_ = static_cast<std::uint64_t>(value);
    announced_line_ = records_.line();
    return true;
  }
  return false;
}

void SeedsText::fail_width(std::size_t columns) const {
  records_.fail(fmt::format("seed {} (from 0) has {} columns, {} {}; give every row a weight or none{}",
                            table_.count(), columns,
                            header_ && table_.count() == 0 ? "the header has" : "the rows before have",
                            columns_->count, separated_by(records_.separator())));
}

void SeedsText::row(Fields& fields) {
  if (!header_ && records_.separator() == '\t') {  // tabs at the ends of lines, as some programs print
    while (fields.back().empty()) fields.pop_back();
    fields.erase(fields.begin(), std::find_if(fields.begin(), fields.end(),
                                              [](std::string_view field) { return !field.empty(); }));
  }
  if (!columns_) columns_ = columns_by_order(records_, fields.size(), dimension_, choice_);
  if (fields.size() != columns_->count) fail_width(fields.size());
  for (std::size_t axis = 0; axis < dimension_; ++axis) {
    const std::size_t column = columns_->position[axis];
    table_.positions.push_back(number(fields[column], column));
  }
  table_.weights.push_back(weight(fields));
  if (header_)
    for (const std::string_view field : fields) table_.text.add(field);
}

double SeedsText::weight(const Fields& fields) const {
  if (!columns_->weight) return 0;
  const std::size_t column = *columns_->weight;
  const double value = number(fields[column], column);
  if (!columns_->radius) return value;
  if (value < 0)
    records_.fail(fmt::format("seed {} (from 0), column {}: the radius is {}; give one of at least 0",
                              table_.count(), column + 1, value));
  return value * value;
}

void SeedsText::require_different_ids() const {
  if (!table_.columns.id || !header_) return;
  std::unordered_map<std::string_view, std::size_t> seed_of;
  for (std::size_t i = 0; i < table_.count(); ++i) {
    const std::string_view id = table_.text.field(i, *table_.columns.id);
    const auto [first, is_new] = seed_of.emplace(id, i);
    if (!is_new)
      fail_file(records_.name(),
                fmt::format("seeds {} and {} (from 0) have the same id '{}'; make ids different, or "
                            "leave --id-column out",
                            first->second, i, id));
  }
}

SeedTable SeedsText::read() {
  Fields fields;
  for (bool first = true; records_.next(fields); first = false)
    if (!first || !first_line(fields)) row(fields);
  if (announced_ && *announced_ != table_.count()) {
    fail_line(
        records_.name(), announced_line_,
        fmt::format("{} seeds are announced, but the file has {}; it is truncated or the count is wrong",
                    *announced_, table_.count()));
  }
  if (columns_) table_.columns = std::move(*columns_);
  require_different_ids();
  return std::move(table_);
}

}  // namespace

SeedTable parse_seeds_text(std::string_view text, int dimension, const std::string& name,
                           const ColumnChoice& choice) {
  if (text.substr(0, 4096).find('\0') != std::string_view::npos)
    fail_line(name, 1, "has NUL bytes; is it text? (.npy files need that extension)");
  return SeedsText(text, dimension, name, choice).read();
}

}  // namespace powercell::io
