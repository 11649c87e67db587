#include "lib/applications/treemap/convex_diagram.hpp"

#include <algorithm>
#include <cmath>

#include "lib/applications/treemap/candidate_scan.hpp"

namespace powercell::treemap_detail {
namespace {

// A bisector that exceeds a cell by less than this, relative to the terms of (3), is not cut: it is rounding
// error, or was tried before.
constexpr double cut_tolerance = 0x1p-50;

}  // namespace

void ConvexDiagram::Cell::reserve(std::size_t vertices) {
  if (x.size() >= vertices) return;
  x.resize(vertices);
  y.resize(vertices);
  side.resize(vertices);
  border.resize(vertices);
}

void ConvexDiagram::set_outline(const Columns& outline) {
  outline_ = outline;
  extent_ = 0;
  for (std::size_t v = 0; v < outline.size(); ++v)
    extent_ = std::max({extent_, std::fabs(outline.x[v]), std::fabs(outline.y[v])});
}

void ConvexDiagram::set_seeds(const Columns& seeds, bool keep_neighbors) {
  const std::size_t n = seeds.size();
  if (!keep_neighbors || n != size()) {
    neighbor_.clear();
    wall_.clear();
    wall_offset_.assign(n + 1, 0);
    tried_.assign(n, 0);
    cell_number_ = 0;
  }
  seeds_ = seeds;
  mass_.resize(n);
  centroid_.resize(n);
}

void ConvexDiagram::start_cell(double x, double y) {
  cell_.count = outline_.size();
  cell_.reserve(cell_.count + 2);
  other_.reserve(cell_.count + 2);
  for (std::size_t v = 0; v < cell_.count; ++v) {
    cell_.x[v] = outline_.x[v] - x;
    cell_.y[v] = outline_.y[v] - y;
    cell_.border[v] = -1;
  }
}

/// Clips the cell by one half-plane, (3), by the algorithm of Sutherland and Hodgman. If rounding puts more
/// than one run of vertices of a convex ring outside, the result is still a closed ring, with extra edges of
/// negligible length.
/// \return whether anything was cut off
bool ConvexDiagram::cut(std::size_t i, std::size_t j, std::span<const double> weights) {
  const double qx = seeds_.x[j] - seeds_.x[i], qy = seeds_.y[j] - seeds_.y[i];
  const double offset = qx * qx + qy * qy + (weights[i] - weights[j]);
  const double tolerance = cut_tolerance * (std::fabs(offset) + (std::fabs(qx) + std::fabs(qy)) * extent_);
  const std::size_t count = cell_.count;
  double most = -1;
  for (std::size_t v = 0; v < count; ++v) {
    cell_.side[v] = 2 * (qx * cell_.x[v] + qy * cell_.y[v]) - offset;
    most = std::max(most, cell_.side[v]);
  }
  if (most <= tolerance) return false;
  other_.reserve(2 * count + 2);
  cell_.reserve(2 * count + 2);
  std::size_t kept = 0;
  const auto keep = [&](double x, double y, std::int32_t border) {
    other_.x[kept] = x;
    other_.y[kept] = y;
    other_.border[kept++] = border;
  };
  for (std::size_t v = 0; v < count; ++v) {
    const std::size_t next = v + 1 == count ? 0 : v + 1;
    const double a = cell_.side[v], b = cell_.side[next];
    if (a <= 0)
      keep(cell_.x[v], cell_.y[v], a == 0 && b > 0 ? static_cast<std::int32_t>(j) : cell_.border[v]);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
      const double t = a / (a - b);
      keep(cell_.x[v] + t * (cell_.x[next] - cell_.x[v]), cell_.y[v] + t * (cell_.y[next] - cell_.y[v]),
           a < 0 ? static_cast<std::int32_t>(j) : cell_.border[v]);
    }
  }
  other_.count = kept;
  std::swap(cell_, other_);
  return true;
}

ConvexDiagram::Box ConvexDiagram::box() const {
  Box box{cell_.x[0], cell_.x[0], cell_.y[0], cell_.y[0]};
  for (std::size_t v = 1; v < cell_.count; ++v) {
    box.low_x = std::min(box.low_x, cell_.x[v]);
    box.high_x = std::max(box.high_x, cell_.x[v]);
    box.low_y = std::min(box.low_y, cell_.y[v]);
    box.high_y = std::max(box.high_y, cell_.y[v]);
  }
  return box;
}

/// Tests all seeds against the box of the cell, (10), a block at a time. Those found clip the cell at once,
/// so that later blocks are tested against a smaller box.
void ConvexDiagram::search(std::size_t i, std::span<const double> weights) {
  constexpr std::size_t block = 128;
  const std::size_t n = size();
  candidate_.resize(block);
  Box around = box();
  for (std::size_t first = 0; first < n; first += block) {
    const ScanBox scan{seeds_.x[i],   seeds_.y[i],  weights[i],   around.low_x,
                       around.high_x, around.low_y, around.high_y};
    const std::size_t found =
        scan_candidates(std::min(block, n - first), seeds_.x.data() + first, seeds_.y.data() + first,
                        weights.data() + first, scan, candidate_.data());
    bool smaller = false;
    for (std::size_t k = 0; k < found && cell_.count > 0; ++k) {
      const std::size_t j = first + candidate_[k];
      if (j == i || tried_[j] == cell_number_) continue;
      smaller |= cut(i, j, weights);
    }
    if (cell_.count == 0) return;
    if (smaller) around = box();
  }
}

void ConvexDiagram::clip(std::size_t i, std::span<const double> weights) {
  ++cell_number_;
  start_cell(seeds_.x[i], seeds_.y[i]);
  for (std::size_t k = last_offset_[i]; k < last_offset_[i + 1] && cell_.count > 0; ++k) {
    const std::uint32_t j = last_neighbor_[k];
    tried_[j] = cell_number_;
    cut(i, j, weights);
  }
  if (cell_.count > 0) search(i, weights);
}

/// Area and centroid by (13), relative to the first vertex, and the walls.
void ConvexDiagram::measure(std::size_t i) {
  double twice = 0, sum_x = 0, sum_y = 0;
  const std::size_t count = cell_.count;
  const double* x = cell_.x.data();
  const double* y = cell_.y.data();
  for (std::size_t v = 1; v + 1 < count; ++v) {
    const double ax = x[v] - x[0], ay = y[v] - y[0], bx = x[v + 1] - x[0], by = y[v + 1] - y[0];
    const double area = ax * by - ay * bx;
    twice += area;
    sum_x += area * (ax + bx);
    sum_y += area * (ay + by);
  }
  mass_[i] = 0.5 * twice;
  if (twice > 0) {
    centroid_.x[i] = seeds_.x[i] + x[0] + sum_x / (3 * twice);
    centroid_.y[i] = seeds_.y[i] + y[0] + sum_y / (3 * twice);
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (cell_.border[v] < 0) continue;
    const std::size_t next = v + 1 == count ? 0 : v + 1;
    neighbor_.push_back(static_cast<std::uint32_t>(cell_.border[v]));
    wall_.push_back(std::hypot(x[next] - x[v], y[next] - y[v]));
  }
}

bool ConvexDiagram::compute(std::span<const double> weights, std::span<const double> least) {
  std::swap(neighbor_, last_neighbor_);
  std::swap(wall_offset_, last_offset_);
  neighbor_.clear();
  wall_.clear();
  wall_offset_.assign(size() + 1, 0);
  for (std::size_t i = 0; i < size(); ++i) {
    clip(i, weights);
    measure(i);
    wall_offset_[i + 1] = neighbor_.size();
    if (mass_[i] > 0 && (least.empty() || mass_[i] >= least[i])) continue;
    std::swap(neighbor_, last_neighbor_);
    std::swap(wall_offset_, last_offset_);
    return false;
  }
  return true;
}

void ConvexDiagram::compute_vertices(std::span<const double> weights, std::vector<std::uint64_t>& offset,
                                     std::vector<double>& vertices) {
  last_neighbor_ = neighbor_;
  last_offset_ = wall_offset_;
  offset.assign(1, 0);
  vertices.clear();
  for (std::size_t i = 0; i < size(); ++i) {
    clip(i, weights);
    // A cell thinner than rounding errors may be left with one or two corners.
    const std::size_t count = cell_.count < 3 ? 0 : cell_.count;
    for (std::size_t v = 0; v < count; ++v) {
      vertices.push_back(seeds_.x[i] + cell_.x[v]);
      vertices.push_back(seeds_.y[i] + cell_.y[v]);
    }
    offset.push_back(vertices.size() / 2);
  }
}

}  // namespace powercell::treemap_detail
