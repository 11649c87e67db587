#include "apps/io/read_masses.hpp"

#include <fmt/format.h>

#include <utility>

#include "apps/io/read_fields.hpp"
#include "apps/io/read_file.hpp"

namespace powercell::io {
namespace {

class MassesText {
 public:
  MassesText(std::string_view text, const std::string& column, const std::string& name)
      : scanner_(text, name), column_(column_name(column)) {}

  std::vector<double> read() {
    Fields fields;
    bool first = true;
    while (const auto line = scanner_.line()) {
      const std::size_t columns = split_fields(scanner_, *line, fields);
      if (!std::exchange(first, false) || !header(fields, columns)) row(fields, columns);
    }
    return std::move(masses_);
  }

 private:
  /// Whether the first line is a header; finds the column.
  bool header(const Fields& fields, std::size_t columns) {
    double value = 0;
    columns_ = columns;
    bool numbers = false;
    for (std::size_t k = 0; k < columns; ++k)
      numbers = numbers || parse_number(fields[k], value) != Parsed::not_a_number;
    if (numbers) {
      if (!column_.empty()) scanner_.fail(fmt::format("no header, so no column '{}'", column_));
      if (columns != 1)
        scanner_.fail(fmt::format("{} columns and no header; give one column, or name it 'mass'", columns));
      return false;
    }
    const std::string wanted = column_.empty() ? "mass" : column_;
    for (std::size_t k = 0; k < columns; ++k)
      if (column_name(fields[k]) == wanted) {
        at_ = k;
        return true;
      }
    if (!column_.empty() || columns != 1)
      scanner_.fail(fmt::format("the header has no column '{}'; name another with --mass-column", wanted));
    return true;
  }

  void row(const Fields& fields, std::size_t columns) {
    const std::size_t seed = masses_.size();
    if (columns != columns_)
      scanner_.fail(
          fmt::format("seed {} (from 0) has {} columns, the ones before have {}", seed, columns, columns_));
    double mass = 0;
    const Parsed parsed = parse_number(fields[at_], mass);
    if (parsed == Parsed::not_a_number)
      scanner_.fail(fmt::format("seed {} (from 0): {}", seed,
                                fields[at_].empty() ? "the mass is empty" : why_not(fields[at_], parsed)));
    if (parsed != Parsed::ok || !(mass > 0))
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("{}:{}: seed {} (from 0): the mass is {}; masses must be positive and finite, "
                              "take the seed out if it is to have nothing",
                              scanner_.name(), scanner_.line_number(), seed, fields[at_]));
    masses_.push_back(mass);
  }

  TextScanner scanner_;
  std::string column_;
  std::size_t columns_ = 0, at_ = 0;
  std::vector<double> masses_;
};

}  // namespace

std::vector<double> parse_masses(std::string_view text, const std::string& column, std::size_t seeds,
                                 const std::string& name) {
  std::vector<double> masses = MassesText(text, column, name).read();
  if (masses.size() != seeds)
    fail_file(name,
              fmt::format("{} masses for {} seeds; one row a seed, in their order", masses.size(), seeds));
  return masses;
}

std::vector<double> read_masses(const std::string& path, const std::string& column, std::size_t seeds) {
  return parse_masses(read_file(path), column, seeds, path);
}

}  // namespace powercell::io
