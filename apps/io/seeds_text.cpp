// Seeds as text or CSV.
#include <fmt/format.h>

#include <array>
#include <optional>

#include "apps/io/read_fields.hpp"
#include "apps/io/read_file.hpp"
#include "apps/io/read_seeds.hpp"
#include "apps/io/read_text.hpp"

namespace powercell::io {
namespace {

class SeedsText {
 public:
  SeedsText(std::string_view text, int dimension, const std::string& name)
      : scanner_(text, name), name_(name), dimension_(static_cast<std::size_t>(dimension)) {
    table_.dimension = dimension;
  }
  SeedTable read();

 private:
  bool first_line(const Fields& fields, std::size_t columns);
  void header(const Fields& fields, std::size_t columns);
  void set_columns(std::size_t columns);
  void row(const Fields& fields, std::size_t columns);
  [[noreturn]] void fail_number(std::string_view field, Parsed parsed, std::size_t column) const;
  std::string layout() const {
    return dimension_ == 2 ? "`x y` or `x y weight`" : "`x y z` or `x y z weight`";
  }

  TextScanner scanner_;
  std::string name_;
  std::size_t dimension_;
  SeedTable table_;
  std::optional<std::uint64_t> announced_;  // by a count line
  std::size_t announced_line_ = 0;
  std::array<std::size_t, 3> position_column_{0, 1, 2};
  std::optional<std::size_t> weight_column_;
  bool by_name_ = false;
  std::size_t columns_ = 0;  // of every row; 0 before the first
};

void SeedsText::fail_number(std::string_view field, Parsed parsed, std::size_t column) const {
  const std::string what =
      fmt::format("{}:{}: seed {} (from 0), column {}: {}", name_, scanner_.line_number(), table_.count(),
                  column + 1, field.empty() ? "is empty" : why_not(field, parsed));
  const bool finite = parsed == Parsed::not_a_number;
  throw Error(finite ? ErrorCode::invalid_file : ErrorCode::invalid_seed,
              what + (finite ? fmt::format("; a row is {}", layout())
                             : "; take the seed out or give it a finite value"));
}

void SeedsText::header(const Fields& fields, std::size_t columns) {
  unsigned found = 0;
  for (std::size_t k = 0; k < columns; ++k) {
    const std::string field = column_name(fields[k]);
    if (field.size() == 1 && field[0] >= 'x' && field[0] <= 'z') {
      position_column_[static_cast<std::size_t>(field[0] - 'x')] = k;
      found |= 1u << (field[0] - 'x');
    } else if (field == "w" || field == "weight") {
      weight_column_ = k;
    }
  }
  if (found == 0) {  // names that say nothing: columns by their order
    weight_column_.reset();
    return;
  }
  if (found != (1u << dimension_) - 1) {
    scanner_.fail(fmt::format(
        "the header names some of x, y, z, but seeds of this domain have {} coordinates", dimension_));
  }
  by_name_ = true;
  columns_ = columns;
}

// Whether the first line is a header or a count, and so not a row.
bool SeedsText::first_line(const Fields& fields, std::size_t columns) {
  double value = 0;
  std::size_t numbers = 0;
  for (std::size_t k = 0; k < columns; ++k) numbers += parse_number(fields[k], value) != Parsed::not_a_number;
  if (numbers == 0) {
    header(fields, columns);
    return true;
  }
  if (columns == 1 && value >= 0 &&
      value == static_cast<double>(static_cast<std::uint64_t>(std::min(value, 1e18)))) {
    announced_ = static_cast<std::uint64_t>(value);
    announced_line_ = scanner_.line_number();
    return true;
  }
  return false;
}

void SeedsText::set_columns(std::size_t columns) {
  columns_ = columns;
  if (columns == dimension_ + 1) {
    weight_column_ = dimension_;
  } else if (columns != dimension_) {
    scanner_.fail(fmt::format(
        "{} columns, but a row of this domain's seeds is {} (or give a header that names x, y, ...)", columns,
        layout()));
  }
}

void SeedsText::row(const Fields& fields, std::size_t columns) {
  if (columns_ == 0) set_columns(columns);
  if (columns != columns_) {
    scanner_.fail(fmt::format(
        "seed {} (from 0) has {} columns, the ones before have {}; give every row a weight or none",
        table_.count(), columns, columns_));
  }
  double value = 0;
  for (std::size_t axis = 0; axis < dimension_; ++axis) {
    const std::size_t column = position_column_[axis];
    const Parsed parsed = parse_number(fields[column], value);
    if (parsed != Parsed::ok) fail_number(fields[column], parsed, column);
    table_.positions.push_back(value);
  }
  value = 0;
  if (weight_column_) {
    const Parsed parsed = parse_number(fields[*weight_column_], value);
    if (parsed != Parsed::ok) fail_number(fields[*weight_column_], parsed, *weight_column_);
  }
  table_.weights.push_back(value);
}

SeedTable SeedsText::read() {
  Fields fields;
  bool first = true;
  while (const auto line = scanner_.line()) {
    const std::size_t columns = split_fields(scanner_, *line, fields);
    if (first && first_line(fields, columns)) {
      first = false;
      continue;
    }
    first = false;
    row(fields, columns);
  }
  if (announced_ && *announced_ != table_.count()) {
    fail_line(name_, announced_line_,
              fmt::format("{} seeds are announced, but the file has {}; it is truncated or the count wrong",
                          *announced_, table_.count()));
  }
  return std::move(table_);
}

}  // namespace

SeedTable parse_seeds_text(std::string_view text, int dimension, const std::string& name) {
  if (text.substr(0, 4096).find('\0') != std::string_view::npos)
    fail_line(name, 1, "has NUL bytes; is it text? (.npy files need that extension)");
  return SeedsText(text, dimension, name).read();
}

}  // namespace powercell::io
