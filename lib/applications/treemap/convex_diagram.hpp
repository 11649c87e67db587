/// \file
/// The power diagram of a few seeds in a convex polygon, on the host: what a group of siblings needs some
/// twenty times, where a launch on a device takes longer than all of them. Internal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/applications/treemap/laplacian.hpp"

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

/// Keeps its memory between groups, and the neighbours of a cell between diagrams of one group: they are the
/// first to cut the next time.
class ConvexDiagram {
 public:
  /// \param outline  convex, counter-clockwise
  void set_outline(const Columns& outline);
  /// Forgets the neighbours when the number of seeds changes or `keep_neighbors` is false.
  void set_seeds(const Columns& seeds, bool keep_neighbors);

  /// The cells for these weights: measures and walls, not the vertices.
  /// \param least  per seed the area its cell must have; may be empty (any cell that is not empty)
  /// \return false as soon as a cell has less, or none at all; the results are then those of no diagram
  bool compute(std::span<const double> weights, std::span<const double> least);
  /// The same with the vertices of every cell, which may be empty, relative to the outline's origin.
  void compute_vertices(std::span<const double> weights, std::vector<std::uint64_t>& offset,
                        std::vector<double>& vertices);

  std::size_t size() const { return seeds_.size(); }
  const Columns& seeds() const { return seeds_; }
  const std::vector<double>& mass() const { return mass_; }  ///< areas
  const Columns& centroid() const { return centroid_; }      ///< of the cells
  Walls walls() const { return {seeds_.x, seeds_.y, wall_offset_, neighbor_, wall_}; }

 private:
  /// A convex polygon about the seed; edge v goes from vertex v to the next and has border[v] behind it: a
  /// seed, or -1 for the outline.
  struct Cell {
    std::vector<double> x, y, side;
    std::vector<std::int32_t> border;
    std::size_t count = 0;
    void reserve(std::size_t vertices);
  };
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
  std::vector<std::uint64_t> tried_;  // per seed: the cell it was last tried on, as a running number
  std::uint64_t cell_number_ = 0;
  Cell cell_, other_;
};

}  // namespace powercell::treemap_detail
