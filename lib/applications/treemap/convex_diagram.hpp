/// \file The power diagram of a few seeds in a convex polygon, on the host. A group of siblings needs some
/// twenty of them, which together take less time than one launch on a device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/applications/treemap/laplacian.hpp"
#include "lib/base/convex_ring.hpp"

namespace powercell::treemap_detail {

/// Points or vectors in columns.
struct Columns {
  std::vector<double> x, y;
  std::size_t size() const { return x.size(); }
  void resize(std::size_t n) {
    x.resize(n);
    y.resize(n);
  }
};

/// Reuses its memory between groups. Within a group it keeps the neighbours of each cell, which are the first
/// to clip the cell in the next diagram.
class ConvexDiagram {
 public:
  /// \param outline  convex, counter-clockwise
  void set_outline(const Columns& outline);
  /// \param keep_neighbors  false to forget the neighbours, as happens if the number of seeds changes
  void set_seeds(const Columns& seeds, bool keep_neighbors);

  /// Computes areas, centroids and walls of the cells.
  /// \param least  per seed: the least area of its cell; empty to accept all cells that are not empty
  /// \return false as soon as a cell is smaller or empty; the results are then invalid
  bool compute(std::span<const double> weights, std::span<const double> least);
  /// Computes the vertices of all cells, which may be empty, in the coordinates of the outline.
  /// \param offset    output, n + 1
  /// \param vertices  output, x, y pairs
  void compute_vertices(std::span<const double> weights, std::vector<std::uint64_t>& offset,
                        std::vector<double>& vertices);

  std::size_t size() const { return seeds_.size(); }
  const Columns& seeds() const { return seeds_; }
  const std::vector<double>& mass() const { return mass_; }  ///< areas
  const Columns& centroid() const { return centroid_; }      ///< of the cells
  Walls walls() const { return {seeds_.x, seeds_.y, wall_offset_, neighbor_, wall_}; }

 private:
  struct Point {
    double x, y;
  };
  /// Relative to the seed. Its edges have the seed across them, or -1 for the outline.
  using Cell = ConvexRing<Point, std::int32_t>;
  struct Box {
    double low_x, high_x, low_y, high_y;
  };

  void start_cell(double x, double y);
  bool cut(std::size_t i, std::size_t j, std::span<const double> weights);
  Box box() const;
  void clip(std::size_t i, std::span<const double> weights);
  void search(std::size_t i, std::span<const double> weights);
  void measure(std::size_t i);

  Columns outline_, seeds_, centroid_;
  double extent_ = 0;
  std::vector<double> mass_, wall_, last_wall_;
  std::vector<std::uint32_t> neighbor_, last_neighbor_, candidate_;
  std::vector<std::uint64_t> wall_offset_, last_offset_;
  std::vector<std::uint64_t> tried_;  // per seed: number of the cell that it was last tried on
  std::uint64_t cell_number_ = 0;
  Cell cell_, other_;
  std::vector<double> side_;  // of the corners, for cut()
};

}  // namespace powercell::treemap_detail
