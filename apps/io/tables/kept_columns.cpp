#include "apps/io/tables/kept_columns.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <span>

#include "apps/io/read/text.hpp"
#include "apps/io/tables/fields.hpp"
#include "apps/io/tables/seeds_columns.hpp"

namespace powercell::io {
namespace {

/// Columns of the tables that the tool writes, besides coordinates and weights.
constexpr std::string_view tool_results[] = {"seed",      "status",      "measure", "mass",
                                             "target",    "cx",          "cy",      "second_moment",
                                             "neighbors", "merged_with", "cz"};

bool is_of_the_tool(const std::vector<std::string>& names) {
  return std::all_of(std::begin(tool_results), std::begin(tool_results) + 2,
                     [&](std::string_view name) {
                       return std::find(names.begin(), names.end(), name) != names.end();
                     }) &&
         std::find(names.begin(), names.end(), "second_moment") != names.end();
}

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether a field is a number as JSON writes them: no leading zeros or plus, so that codes such as 00501
/// stay text.
bool is_plain_number(std::string_view field, char mark, bool& whole) {
  double value = 0;
  if (parse_number(field, mark, value) != Parsed::ok || field[0] == '+') return false;
  const std::string_view digits = field.substr(field[0] == '-' ? 1 : 0);
  if (digits.size() > 1 && digits[0] == '0' && digits[1] != mark && digits[1] != 'e' && digits[1] != 'E')
    return false;
  whole = whole && digits.size() <= 15 && digits.find_first_not_of("0123456789") == std::string_view::npos;
  return true;
}

}  // namespace

KeptColumns::KeptColumns(const InputView& inputs, const SeedsView& seeds,
                         std::initializer_list<std::string_view> results) {
  if (inputs.table == nullptr || inputs.table->text.columns == 0) return;
  table_ = inputs.table;
  const SeedColumns& taken = table_->columns;
  const bool again = is_of_the_tool(taken.names);
  positions_ = taken.named;
  const bool same =
      std::equal(seeds.weights.begin(), seeds.weights.end(), table_->weights.begin(), table_->weights.end());
  weights_ = same && taken.weight && !taken.radius && !table_->scaled &&
             is_weight_name(column_name(taken.names[*taken.weight]));
  std::set<std::string> used(results.begin(), results.end());
  if (!weights_) used.insert("weight");
  for (std::size_t k = 0; k < taken.names.size(); ++k) {
    std::string name = taken.names[k];
    const std::string known = column_name(name);
    if (again && contains(tool_results, known)) continue;
    if (again && !weights_ && known == "weight") continue;
    const bool misread = !weights_ && is_weight_name(known);
    if (misread || used.count(known) != 0) name.insert(0, "input_");
    while (used.count(column_name(name)) != 0) name += "_";
    used.insert(column_name(name));
    columns_.push_back({k, std::move(name), type_of(k)});
  }
}

std::string_view KeptColumns::field(std::size_t row, const KeptColumn& column) const {
  return table_->text.field(row, column.index);
}

KeptColumn::Type KeptColumns::type_of(std::size_t column) const {
  bool whole = true, any = false;
  for (std::size_t row = 0; row < table_->text.rows(); ++row) {
    const std::string_view field = table_->text.field(row, column);
    if (field.empty()) continue;
    any = true;
    if (!is_plain_number(field, mark(), whole)) return KeptColumn::Type::text;
  }
  return !any ? KeptColumn::Type::text : whole ? KeptColumn::Type::whole : KeptColumn::Type::real;
}

double KeptColumns::number(std::size_t row, const KeptColumn& column) const {
  double value = 0;
  const bool is_number = parse_number(field(row, column), mark(), value) == Parsed::ok;
  return is_number ? value : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> KeptColumns::numbers(const KeptColumn& column) const {
  std::vector<double> values;
  for (std::size_t row = 0; row < table_->text.rows(); ++row) values.push_back(number(row, column));
  return values;
}

}  // namespace powercell::io
