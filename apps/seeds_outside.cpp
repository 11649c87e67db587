#include "apps/seeds_outside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "apps/common.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read_fields.hpp"

namespace powercell::app {
namespace {

constexpr std::size_t most_rows = 2000;   // of the sample on which other columns are tried
constexpr std::size_t most_columns = 10;  // tried as coordinates
constexpr std::size_t fewest_refused = 10;
constexpr double rounding = 1e-9;  // over the diagonal
constexpr const char* axis_names = "xyz";

double diagonal(const SeedBox& box) {
  return std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
}

/// A column of numbers, of a sample of the rows.
struct Column {
  std::size_t index;
  std::vector<double> values;
};

/// The numeric columns of the table, those of the coordinates first.
std::vector<Column> numeric_columns(const io::SeedTable& seeds) {
  const std::size_t n = seeds.count(), step = (n + most_rows - 1) / most_rows;
  const auto d = static_cast<std::size_t>(seeds.dimension);
  std::vector<Column> columns;
  for (std::size_t k = 0; k < d; ++k) {
    columns.push_back({seeds.columns.position[k], {}});
    for (std::size_t i = 0; i < n; i += step) columns.back().values.push_back(seeds.positions[i * d + k]);
  }
  if (seeds.text.columns == 0) {
    if (!seeds.columns.weight || seeds.columns.radius) return columns;
    columns.push_back({*seeds.columns.weight, {}});
    for (std::size_t i = 0; i < n; i += step) columns.back().values.push_back(seeds.weights[i]);
    return columns;
  }
  for (std::size_t k = 0; k < seeds.text.columns && columns.size() < most_columns; ++k) {
    if (std::any_of(columns.begin(), columns.end(), [k](const Column& c) { return c.index == k; })) continue;
    Column column{k, {}};
    double value = 0;
    for (std::size_t i = 0;
         i < n && io::parse_number(seeds.text.field(i, k), seeds.text.mark, value) == io::Parsed::ok;
         i += step)
      column.values.push_back(value);
    if (column.values.size() == columns[0].values.size()) columns.push_back(std::move(column));
  }
  return columns;
}

/// The columns that put the most seeds into the box.
class BestColumns {
 public:
  BestColumns(const SeedBox& box, std::vector<Column> columns) : box_(box), columns_(std::move(columns)) {
    std::sort(columns_.begin(), columns_.end(),
              [](const Column& a, const Column& b) { return a.index < b.index; });
    extend(0);
  }
  /// Empty unless they put at least half of them there.
  std::vector<std::size_t> found() const {
    std::vector<std::size_t> indices;
    if (2 * inside_ < rows()) return indices;
    for (std::size_t k = 0; k < box_.dimension; ++k) indices.push_back(columns_[best_[k]].index);
    return indices;
  }
  double share() const { return static_cast<double>(inside_) / static_cast<double>(rows()); }

 private:
  std::size_t rows() const { return columns_[0].values.size(); }

  void extend(std::size_t axis) {
    if (axis == box_.dimension) {
      const std::size_t inside = count();
      if (inside > inside_) {
        inside_ = inside;
        best_ = tried_;
      }
      return;
    }
    const auto used = tried_.begin() + static_cast<std::ptrdiff_t>(axis);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (std::find(tried_.begin(), used, k) != used) continue;
      tried_[axis] = k;
      extend(axis + 1);
    }
  }

  std::size_t count() const {
    std::size_t inside = 0;
    for (std::size_t i = 0; i < rows(); ++i) {
      std::array<double, 3> p{};
      for (std::size_t k = 0; k < box_.dimension; ++k) p[k] = columns_[tried_[k]].values[i];
      inside += box_.contains(p.data());
    }
    return inside;
  }

  const SeedBox& box_;
  std::vector<Column> columns_;
  std::array<std::size_t, 3> tried_{}, best_{};
  std::size_t inside_ = 0;
};

/// Advice to take other columns; empty if none fit better.
std::string other_columns(const SeedBox& box, const io::SeedTable& seeds) {
  if (seeds.columns.count == 0) return {};  // not of a table
  const BestColumns best(box, numeric_columns(seeds));
  const std::vector<std::size_t> found = best.found();
  if (found.empty()) return {};
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
  return fmt::format("with {} {:.0f} % would lie inside: try{}", axes, 100 * best.share(), options);
}

/// Whether these could be longitudes and latitudes.
bool like_degrees(const SeedBox& box) {
  return box.low[0] >= -180 && box.high[0] <= 360 && box.low[1] >= -90 && box.high[1] <= 90;
}

/// Whether these could be metres or the like on a map.
bool like_lengths(const SeedBox& box) {
  constexpr double far = 1000;
  return std::max({-box.low[0], box.high[0], -box.low[1], box.high[1]}) > far;
}

/// Advice on units; empty if nothing is recognized.
std::string other_units(const SeedBox& box, const io::SeedTable& seeds) {
  const std::size_t d = box.dimension;
  SeedBox extent{d, {}, {}, 0};
  for (std::size_t k = 0; k < d; ++k) {
    extent.low[k] = extent.high[k] = seeds.positions[k];
    for (std::size_t i = k; i < seeds.positions.size(); i += d) {
      extent.low[k] = std::min(extent.low[k], seeds.positions[i]);
      extent.high[k] = std::max(extent.high[k], seeds.positions[i]);
    }
  }
  if (d == 2 && like_degrees(box) && like_lengths(extent))
    return "the domain could be in degrees and the seeds in lengths: name the system of the seeds with "
           "--seeds-crs EPSG:..., and that of the domain with --crs EPSG:4326";
  if (d == 2 && like_lengths(box) && like_degrees(extent))
    return "the seeds could be in degrees and the domain in lengths: say so with --seeds-crs EPSG:4326, and "
           "name the system of the domain with --crs EPSG:... if its file does not";
  for (const double factor : {1e3, 1e-3, 1e2, 1e-2, 1e1, 1e-1}) {
    std::size_t inside = 0;
    for (std::size_t i = 0; i < seeds.count(); ++i) {
      std::array<double, 3> p{};
      for (std::size_t k = 0; k < d; ++k) p[k] = factor * seeds.positions[i * d + k];
      inside += box.contains(p.data());
    }
    if (seeds.count() > 2 && 10 * inside >= 9 * seeds.count())
      return fmt::format("{} times their coordinates would lie inside: give both in one unit", factor);
  }
  return {};
}

}  // namespace

bool SeedBox::contains(const double* point) const {
  for (std::size_t k = 0; k < dimension; ++k)
    if (!(point[k] >= low[k] - margin && point[k] <= high[k] + margin)) return false;
  return true;
}

SeedBox seed_box(const Domain& domain) {
  SeedBox box{static_cast<std::size_t>(domain.dimension()), domain.low(), domain.high(), 0};
  if (domain.is_periodic()) {
    // Seeds outside stand for their images inside, except along bounded axes.
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < box.dimension; ++k)
      if (domain.periods()[k] != std::array<double, 3>{}) {
        box.low[k] = -infinity;
        box.high[k] = infinity;
      }
    return box;
  }
  box.margin = (domain.kind() == DomainKind::surface ? 0.5 : rounding) * diagonal(box);
  return box;
}

SeedBox seed_box(const std::vector<PolygonPart>& parts) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  SeedBox box{2, {infinity, infinity, 0}, {-infinity, -infinity, 0}, 0};
  for (const PolygonPart& part : parts)
    for (const auto& point : part.outer)
      for (std::size_t k = 0; k < 2; ++k) {
        box.low[k] = std::min(box.low[k], point[k]);
        box.high[k] = std::max(box.high[k], point[k]);
      }
  box.margin = rounding * diagonal(box);
  return box;
}

std::size_t count_outside(const SeedBox& box, const std::vector<double>& positions) {
  std::size_t outside = 0;
  for (std::size_t i = 0; i < positions.size(); i += box.dimension) outside += !box.contains(&positions[i]);
  return outside;
}

std::string outside_line(std::size_t outside, std::size_t seeds) {
  return fmt::format("{} of {} seeds {} outside the domain's box", with_commas(outside), with_commas(seeds),
                     outside == 1 ? "lies" : "lie");
}

std::optional<Miss> find_miss(const SeedBox& box, const std::vector<double>& positions,
                              const io::SeedTable& table, bool transformed) {
  const std::size_t n = table.count(), outside = count_outside(box, positions);
  if (outside == 0 || 20 * (n - outside) >= n) return std::nullopt;
  Miss miss{n >= fewest_refused, outside_line(outside, n) + " ("};
  for (std::size_t k = 0; k < box.dimension; ++k)
    miss.message +=
        fmt::format("{}{} from {:.6g} to {:.6g}", k == 0 ? "" : ", ", axis_names[k], box.low[k], box.high[k]);
  miss.message += ")";
  if (!table.columns.taken.empty()) miss.message += "; they were read as " + table.columns.taken;
  if (transformed) {
    miss.message +=
        ", and transformed to the domain's coordinate system: check --seeds-crs, and that x is the longitude";
  } else {
    std::string advice = other_columns(box, table);
    if (advice.empty()) advice = other_units(box, table);
    if (!advice.empty()) miss.message += "; " + advice;
  }
  return miss;
}

}  // namespace powercell::app
