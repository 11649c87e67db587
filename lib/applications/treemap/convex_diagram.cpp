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
  cell_.clear();
  for (std::size_t v = 0; v < outline_.size(); ++v)
    cell_.push_back({{outline_.x[v] - x, outline_.y[v] - y}, -1});
}

/// Clips the cell by one half-plane, (3). If rounding puts more than one run of corners outside, the result
/// is still a closed ring, with extra edges of negligible length.
/// \return whether anything was cut off
bool ConvexDiagram::cut(std::size_t i, std::size_t j, std::span<const double> weights) {
  const double qx = seeds_.x[j] - seeds_.x[i], qy = seeds_.y[j] - seeds_.y[i];
  const double offset = qx * qx + qy * qy + (weights[i] - weights[j]);
  const double tolerance = cut_tolerance * (std::fabs(offset) + (std::fabs(qx) + std::fabs(qy)) * extent_);
  double most = -1;
  side_.resize(cell_.size());
  for (std::size_t v = 0; v < cell_.size(); ++v) {
    side_[v] = 2 * (qx * cell_[v].at.x + qy * cell_[v].at.y) - offset;
    most = std::max(most, side_[v]);
  }
  if (most <= tolerance) return false;
  const auto meet = [&](std::size_t kept, std::size_t lost, std::int32_t, std::int32_t) {
    const double share = side_[kept] / (side_[kept] - side_[lost]);
    const Point &in = other_[kept].at, &out = other_[lost].at;
    return Point{in.x + share * (out.x - in.x), in.y + share * (out.y - in.y)};
  };
  cut_ring(cell_, side_, static_cast<std::int32_t>(j), meet, other_);
  return true;
}

ConvexDiagram::Box ConvexDiagram::box() const {
  const Point& first = cell_.front().at;
  Box box{first.x, first.x, first.y, first.y};
  for (const auto& [at, edge] : cell_) {
    box.low_x = std::min(box.low_x, at.x);
    box.high_x = std::max(box.high_x, at.x);
    box.low_y = std::min(box.low_y, at.y);
    box.high_y = std::max(box.high_y, at.y);
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
    for (std::size_t k = 0; k < found && !cell_.empty(); ++k) {
      const std::size_t j = first + candidate_[k];
      if (j == i || tried_[j] == cell_number_) continue;
      smaller |= cut(i, j, weights);
    }
    if (cell_.empty()) return;
    if (smaller) around = box();
  }
}

void ConvexDiagram::clip(std::size_t i, std::span<const double> weights) {
  ++cell_number_;
  start_cell(seeds_.x[i], seeds_.y[i]);
  for (std::size_t k = last_offset_[i]; k < last_offset_[i + 1] && !cell_.empty(); ++k) {
    const std::uint32_t j = last_neighbor_[k];
    tried_[j] = cell_number_;
    cut(i, j, weights);
  }
  if (!cell_.empty()) search(i, weights);
}

/// Area and centroid by (13), relative to the first vertex, and the walls.
void ConvexDiagram::measure(std::size_t i) {
  double twice = 0, sum_x = 0, sum_y = 0;
  for (std::size_t v = 1; v + 1 < cell_.size(); ++v) {
    const Point &o = cell_[0].at, &a = cell_[v].at, &b = cell_[v + 1].at;
    const double ax = a.x - o.x, ay = a.y - o.y, bx = b.x - o.x, by = b.y - o.y;
    const double area = ax * by - ay * bx;
    twice += area;
    sum_x += area * (ax + bx);
    sum_y += area * (ay + by);
  }
  mass_[i] = 0.5 * twice;
  if (twice > 0) {
    centroid_.x[i] = seeds_.x[i] + cell_[0].at.x + sum_x / (3 * twice);
    centroid_.y[i] = seeds_.y[i] + cell_[0].at.y + sum_y / (3 * twice);
  }
  for (std::size_t v = 0; v < cell_.size(); ++v) {
    const auto& [from, border] = cell_[v];
    if (border < 0) continue;
    const Point& to = cell_[v + 1 == cell_.size() ? 0 : v + 1].at;
    neighbor_.push_back(static_cast<std::uint32_t>(border));
    wall_.push_back(std::hypot(to.x - from.x, to.y - from.y));
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
    if (cell_.size() >= 3)
      for (const auto& [at, edge] : cell_)
        vertices.insert(vertices.end(), {seeds_.x[i] + at.x, seeds_.y[i] + at.y});
    offset.push_back(vertices.size() / 2);
  }
}

}  // namespace powercell::treemap_detail
