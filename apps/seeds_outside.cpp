#include "apps/seeds_outside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <powercell/error.hpp>

#include "apps/io/printable.hpp"
#include "apps/io/tables/fields.hpp"

namespace powercell::app {
namespace {

constexpr std::size_t most_columns = 10;  // tried as coordinates
constexpr std::size_t fewest_refused = 10;
constexpr const char* axis_names = "xyz";

/// The numeric columns of the table, those of the coordinates first. None if it has no columns.
std::vector<io::Column> numeric_columns(const io::SeedTable& seeds) {
  if (seeds.columns.count == 0) return {};
  const std::size_t n = seeds.count(), step = io::sample_step(n);
  std::vector<io::Column> columns =
      io::coordinate_columns(seeds.positions, static_cast<std::size_t>(seeds.dimension));
  for (io::Column& column : columns) column.index = seeds.columns.position[column.index];
  if (seeds.text.columns == 0) {
    if (!seeds.columns.weight || seeds.columns.radius) return columns;
    columns.push_back({*seeds.columns.weight, {}});
    for (std::size_t i = 0; i < n; i += step) columns.back().values.push_back(seeds.weights[i]);
    return columns;
  }
  for (std::size_t k = 0; k < seeds.text.columns && columns.size() < most_columns; ++k) {
    if (std::any_of(columns.begin(), columns.end(), [k](const io::Column& c) { return c.index == k; }))
      continue;
    io::Column column{k, {}};
    double value = 0;
    for (std::size_t i = 0;
         i < n && io::parse_number(seeds.text.field(i, k), seeds.text.mark, value) == io::Parsed::ok;
         i += step)
      column.values.push_back(value);
    if (column.values.size() == columns[0].values.size()) columns.push_back(std::move(column));
  }
  return columns;
}

std::string other_columns(const io::WayIn& way, const io::SeedTable& seeds) {
  const std::vector<std::size_t>& found = way.columns;
  const auto& names = seeds.columns.names;
  std::string axes, options;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::string column =
        names.empty() ? std::to_string(found[k] + 1) : fmt::format("'{}'", io::readable(names[found[k]]));
    axes += fmt::format("{}{} from {}{}", k == 0 ? "" : ", ", axis_names[k], names.empty() ? "column " : "",
                        column);
    options += fmt::format(" --{}-column {}", axis_names[k], column);
  }
  const auto weight = seeds.columns.weight;
  if (names.empty() && weight && std::find(found.begin(), found.end(), *weight) == found.end())
    options += fmt::format(" --{}-column {}", seeds.columns.radius ? "radius" : "weight", *weight + 1);
  return fmt::format("with {} {:.0f} % would lie inside: try{}", axes, 100 * way.share, options);
}

/// The options that bring the seeds in; empty if nothing is recognized.
std::string advice(const io::WayIn& way, const io::SeedTable& seeds) {
  switch (way.kind) {
    case io::WayIn::Kind::columns:
      return other_columns(way, seeds);
    case io::WayIn::Kind::seeds_in_lengths:
      return "the domain could be in degrees and the seeds in lengths: name the system of the seeds with "
             "--seeds-crs EPSG:..., and that of the domain with --crs EPSG:4326";
    case io::WayIn::Kind::seeds_in_degrees:
      return "the seeds could be in degrees and the domain in lengths: say so with --seeds-crs EPSG:4326, "
             "and "
             "name the system of the domain with --crs EPSG:... if its file does not";
    case io::WayIn::Kind::unit:
      return fmt::format("{} times their coordinates would lie inside: give both in one unit", way.factor);
    default:
      return {};
  }
}

}  // namespace

std::optional<Miss> find_miss(const io::SeedBox& box, const std::vector<double>& positions,
                              const io::SeedTable& table, bool transformed) {
  if (!io::most_outside(box, positions)) return std::nullopt;
  Miss miss{table.count() >= fewest_refused, io::outside_line(box, positions, true)};
  if (!table.columns.taken.empty()) miss.message += "; they were read as " + table.columns.taken;
  if (transformed) {
    miss.message +=
        ", and transformed to the domain's coordinate system: check --seeds-crs, and that x is the longitude";
  } else {
    const std::string other = advice(io::way_in(box, table.positions, numeric_columns(table)), table);
    if (!other.empty()) miss.message += "; " + other;
  }
  return miss;
}

void require_inside(std::uint64_t outside, std::uint64_t seeds) {
  if (outside == 0 || (seeds - outside) * 20 >= seeds) return;
  throw Error(ErrorCode::invalid_seed,
              fmt::format("{} of {} seeds lie outside the domain's box; if they are meant to lie there, give "
                          "--allow-outside",
                          io::with_commas(outside), io::with_commas(seeds)));
}

}  // namespace powercell::app
