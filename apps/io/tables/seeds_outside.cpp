#include "apps/io/tables/seeds_outside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

constexpr std::size_t most_rows = 2000;  // of the sample on which other columns are tried
constexpr double rounding = 1e-9;        // over the diagonal

double diagonal(const SeedBox& box) {
  return std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
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

/// Whether these could be longitudes and latitudes.
bool like_degrees(const SeedBox& box) {
  return box.low[0] >= -180 && box.high[0] <= 360 && box.low[1] >= -90 && box.high[1] <= 90;
}

/// Whether these could be metres or the like on a map.
bool like_lengths(const SeedBox& box) {
  constexpr double far = 1000;
  return std::max({-box.low[0], box.high[0], -box.low[1], box.high[1]}) > far;
}

SeedBox extent_of(std::span<const double> positions, std::size_t dimension) {
  SeedBox extent{dimension, {}, {}, 0};
  for (std::size_t k = 0; k < dimension; ++k) {
    extent.low[k] = extent.high[k] = positions[k];
    for (std::size_t i = k; i < positions.size(); i += dimension) {
      extent.low[k] = std::min(extent.low[k], positions[i]);
      extent.high[k] = std::max(extent.high[k], positions[i]);
    }
  }
  return extent;
}

WayIn other_units(const SeedBox& box, std::span<const double> positions) {
  const std::size_t d = box.dimension, n = positions.size() / d;
  const SeedBox extent = extent_of(positions, d);
  WayIn way;
  if (d == 2 && like_degrees(box) && like_lengths(extent)) way.kind = WayIn::Kind::seeds_in_lengths;
  if (d == 2 && like_lengths(box) && like_degrees(extent)) way.kind = WayIn::Kind::seeds_in_degrees;
  if (way.kind != WayIn::Kind::none) return way;
  // Seeds of another unit are spread over the box; others come near its corner with any small factor.
  constexpr double least_spread = 0.2;
  for (const double factor : {1e3, 1e-3, 1e2, 1e-2, 1e1, 1e-1}) {
    bool spread = false;
    for (std::size_t k = 0; k < d; ++k)
      spread =
          spread || factor * (extent.high[k] - extent.low[k]) > least_spread * (box.high[k] - box.low[k]);
    if (!spread) continue;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < n; ++i) {
      std::array<double, 3> p{};
      for (std::size_t k = 0; k < d; ++k) p[k] = factor * positions[i * d + k];
      inside += box.contains(p.data());
    }
    if (n <= 2 || 10 * inside < 9 * n) continue;
    way.kind = WayIn::Kind::unit;
    way.factor = factor;
    return way;
  }
  return way;
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

std::size_t count_outside(const SeedBox& box, std::span<const double> positions) {
  std::size_t outside = 0;
  for (std::size_t i = 0; i < positions.size(); i += box.dimension) outside += !box.contains(&positions[i]);
  return outside;
}

bool most_outside(const SeedBox& box, std::span<const double> positions) {
  const std::size_t n = positions.size() / box.dimension;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < positions.size() && 20 * inside < n; i += box.dimension)
    inside += box.contains(&positions[i]);
  return 20 * inside < n;
}

std::string outside_line(const SeedBox& box, std::span<const double> positions, bool with_box) {
  const std::size_t outside = count_outside(box, positions);
  std::string line =
      fmt::format("{} of {} seeds {} outside the domain's box", with_commas(outside),
                  with_commas(positions.size() / box.dimension), outside == 1 ? "lies" : "lie");
  if (!with_box) return line;
  for (std::size_t k = 0; k < box.dimension; ++k)
    line +=
        fmt::format("{}{} from {:.6g} to {:.6g}", k == 0 ? " (" : ", ", "xyz"[k], box.low[k], box.high[k]);
  return line + ")";
}

std::size_t sample_step(std::size_t n) {
  return (n + most_rows - 1) / most_rows;
}

std::vector<Column> coordinate_columns(std::span<const double> positions, std::size_t dimension) {
  const std::size_t n = positions.size() / dimension, step = sample_step(n);
  std::vector<Column> columns;
  for (std::size_t k = 0; k < dimension; ++k) {
    columns.push_back({k, {}});
    for (std::size_t i = 0; i < n; i += step) columns.back().values.push_back(positions[i * dimension + k]);
  }
  return columns;
}

WayIn way_in(const SeedBox& box, std::span<const double> positions, std::vector<Column> columns) {
  if (columns.empty()) return other_units(box, positions);
  const BestColumns best(box, std::move(columns));
  std::vector<std::size_t> found = best.found();
  if (found.empty()) return other_units(box, positions);
  return {WayIn::Kind::columns, std::move(found), best.share(), 1};
}

}  // namespace powercell::io
