#include "apps/io/tables/read_masses.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/io/closest.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/tables/fields.hpp"

namespace powercell::io {
namespace {

class MassesText {
 public:
  MassesText(std::string_view text, const std::string& column, const std::string& name)
      : records_(text, name, number_separator(text, '#'), '#'),
        numbers_(records_.separator()),
        column_(column_name(column)) {}

  std::vector<double> read() {
    Fields fields;
    for (bool first = true; records_.next(fields); first = false)
      if (!first || !header(fields)) row(fields);
    return std::move(masses_);
  }

 private:
  /// Whether the first line is a header; sets the column.
  bool header(const Fields& fields) {
    columns_ = fields.size();
    if (!is_header(fields)) {
      if (!column_.empty()) records_.fail(fmt::format("no header, so no column '{}'", column_));
      if (columns_ != 1)
        records_.fail(fmt::format("{} columns and no header; give one column, or name it 'mass'{}", columns_,
                                  separated_by(records_.separator())));
      return false;
    }
    const std::string wanted = column_.empty() ? "mass" : column_;
    std::size_t found = 0;
    for (std::size_t k = 0; k < columns_; ++k) {
      if (column_name(fields[k]) != wanted) continue;
      at_ = k;
      ++found;
    }
    if (found > 1) records_.fail(fmt::format("the header has {} columns '{}'; rename one", found, wanted));
    if (found == 0 && (!column_.empty() || columns_ != 1))
      records_.fail(
          fmt::format("the header has no column '{}'; name another with --mass-column{}{}", wanted,
                      separated_by(records_.separator()),
                      did_you_mean(closest(wanted, std::vector<std::string>(fields.begin(), fields.end())))));
    return true;
  }

  void row(const Fields& fields) {
    const std::size_t seed = masses_.size();
    if (fields.size() != columns_)
      records_.fail(fmt::format("seed {} (from 0) has {} columns, the ones before have {}{}", seed,
                                fields.size(), columns_, separated_by(records_.separator())));
    double mass = 0;
    const Parsed parsed = numbers_.read(fields[at_], mass);
    if (parsed == Parsed::not_a_number)
      records_.fail(
          fmt::format("seed {} (from 0): {}", seed,
                      fields[at_].empty() ? "the mass is empty" : numbers_.why_not(fields[at_], parsed)));
    if (parsed != Parsed::ok || !(mass > 0))
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("{}: seed {} (from 0): the mass is {}; masses must be positive and finite; "
                              "remove seeds without mass",
                              records_.place(), seed, fields[at_]));
    masses_.push_back(mass);
  }

  Records records_;
  FieldNumbers numbers_;
  std::string column_;
  std::size_t columns_ = 0, at_ = 0;
  std::vector<double> masses_;
};

}  // namespace

std::vector<double> parse_masses(std::string_view text, const std::string& column, std::size_t seeds,
                                 const std::string& name) {
  std::vector<double> masses = MassesText(text, column, name).read();
  if (masses.size() != seeds)
    fail_file(name, fmt::format("{} masses for {} seeds; give one row for each seed, in their order",
                                masses.size(), seeds));
  return masses;
}

std::vector<double> read_masses(const std::string& path, const std::string& column, std::size_t seeds) {
  return parse_masses(read_file(path), column, seeds, path);
}

std::vector<double> masses_of_table(const SeedTable& seeds, const std::string& column,
                                    const std::string& name) {
  const std::vector<std::string>& names = seeds.columns.names;
  const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& known) {
    return column_name(known) == column_name(column);
  });
  if (found == names.end())
    fail_file(name, fmt::format("the table of the seeds has no column '{}'; name one of its header, or give "
                                "--masses with another table{}",
                                column, did_you_mean(closest(column, names))));
  std::vector<double> masses;
  for (std::size_t i = 0; i < seeds.count(); ++i) {
    const std::string_view field = seeds.text.field(i, static_cast<std::size_t>(found - names.begin()));
    double mass = 0;
    const Parsed parsed = parse_number(field, seeds.text.mark, mass);
    if (parsed == Parsed::ok && mass > 0) {
      masses.push_back(mass);
      continue;
    }
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format("{}: seed {} (from 0): the mass '{}' is not a number above 0; remove seeds without "
                    "mass",
                    name, i, readable(std::string(field))));
  }
  return masses;
}

}  // namespace powercell::io
