#include "apps/io/picture/colouring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <powercell/error.hpp>
#include <set>

#include "apps/io/picture/colour_scales.hpp"
#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

std::optional<int> hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = static_cast<char>(c | 32);
  if (lower >= 'a' && lower <= 'f') return lower - 'a' + 10;
  return std::nullopt;
}

std::optional<Colour> named_colour(std::string_view text) {
  if ((text.size() != 4 && text.size() != 7) || text[0] != '#') return std::nullopt;
  const std::size_t digits = text.size() == 7 ? 2 : 1;
  std::array<std::uint8_t, 3> channel{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto first = hex_digit(text[1 + c * digits]), last = hex_digit(text[c * digits + digits]);
    if (!first || !last) return std::nullopt;
    channel[c] = static_cast<std::uint8_t>(*first * 16 + *last);
  }
  return Colour{channel[0], channel[1], channel[2]};
}

bool are_colours(std::span<const std::string_view> values) {
  bool any = false;
  for (const std::string_view value : values) {
    if (value.empty()) continue;
    if (!named_colour(value)) return false;
    any = true;
  }
  return any;
}

void add_missing(Colouring& colouring, const std::vector<char>& shown) {
  std::size_t missing = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) missing += shown[i] != 0 && colouring.is_striped(i) ? 1 : 0;
  if (missing > 0)
    colouring.legend.entries.push_back(
        {Legend::Mark::no_value, no_value, fmt::format("no value ({})", with_commas(missing))});
}

}  // namespace

double share_of_range(double value, double low, double high) {
  return (value / 2 - low / 2) / (high / 2 - low / 2);  // halves do not overflow
}

Colouring colours_of_numbers(std::span<const double> values, const std::vector<char>& shown, bool whole) {
  const std::size_t n = values.size();
  Colouring colouring{std::vector<Colour>(n, no_value), std::vector<char>(n, 0), {}};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < n; ++i) {
    colouring.has_value[i] = std::isfinite(values[i]) ? 1 : 0;
    if (shown[i] == 0 || colouring.has_value[i] == 0) continue;
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  // Differences that rounding makes are none.
  const bool differ =
      high / 2 - low / 2 > 1e-300 && high / 2 - low / 2 > 1e-12 * std::max(std::abs(low), std::abs(high));
  for (std::size_t i = 0; i < n; ++i)
    if (colouring.has_value[i] != 0)
      colouring.colour[i] = scale_colour(differ ? share_of_range(values[i], low, high) : 0.5);
  Legend& legend = colouring.legend;
  if (low < high && differ) {
    legend.scale = true;
    legend.low = low;
    legend.high = high;
    legend.whole = whole;
  } else if (low <= high) {
    legend.entries.push_back({Legend::Mark::colour, scale_colour(0.5), fmt::format("{:.6g}", low)});
  }
  add_missing(colouring, shown);
  return colouring;
}

Colouring colours_of_texts(std::span<const std::string_view> values, const std::vector<char>& shown) {
  const std::size_t n = values.size();
  Colouring colouring{std::vector<Colour>(n, no_value), std::vector<char>(n, 0), {}};
  const bool themselves = are_colours(values);
  std::map<std::string_view, Colour> classes;
  for (std::size_t i = 0; i < n; ++i)
    if (shown[i] != 0 && !values[i].empty()) classes.emplace(values[i], Colour{});
  const std::vector<Colour> distinct = themselves ? std::vector<Colour>() : class_colours(classes.size());
  std::size_t k = 0;
  for (auto& [text, colour] : classes) {
    colour = themselves ? *named_colour(text) : distinct[k++];
    if (!themselves)
      colouring.legend.entries.push_back({Legend::Mark::colour, colour, printable(std::string(text))});
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (values[i].empty()) continue;
    colouring.has_value[i] = 1;
    if (const auto found = classes.find(values[i]); found != classes.end())
      colouring.colour[i] = found->second;
  }
  add_missing(colouring, shown);
  return colouring;
}

void check_classes(std::span<const std::string_view> values, const std::string& column) {
  if (are_colours(values)) return;
  std::set<std::string_view> distinct(values.begin(), values.end());
  distinct.erase("");
  if (distinct.size() > most_classes)
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format("--color-by {}: the column has {} different texts, of which {} can be told apart by "
                    "colours; choose a column with numbers, colours such as #3a6b9c, or fewer texts",
                    readable(column), with_commas(distinct.size()), most_classes));
}

}  // namespace powercell::io
