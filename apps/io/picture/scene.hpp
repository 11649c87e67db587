/// \file
/// A flat picture as shapes, to be drawn as SVG text or by cairo.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/io/picture/legend.hpp"
#include "apps/io/picture/palette.hpp"
#include "apps/io/write/output.hpp"

namespace powercell::io {

/// Everything in pixels, or in points of a page, y downwards.
struct Scene {
  /// Rings of points: ring r has the points [offset[r], offset[r+1]) of x, y pairs.
  struct Rings {
    std::vector<std::uint64_t> offset = {0};
    std::vector<double> points;
    std::size_t size() const { return offset.size() - 1; }
    void add(double x, double y) {
      points.push_back(x);
      points.push_back(y);
    }
    void end_ring() { offset.push_back(points.size() / 2); }
  };
  struct Cell {
    std::uint32_t seed;
    Colour fill;
    std::uint64_t first_ring, end_ring;  ///< of `cell_rings`, filled by the even-odd rule
    std::string label;                   ///< tool tip; empty in large pictures
    bool striped = false;                ///< instead of `fill`: it has no value
  };
  enum class Mark {
    dot,        ///< the seed itself
    positive,   ///< disc of a positive weight
    negative,   ///< of a negative one: a dashed ring
    hidden,     ///< a seed without a cell: a hollow dot
    duplicate,  ///< a seed on another seed: a cross
  };
  struct Disc {
    Mark mark;
    std::uint32_t seed;
    double x, y, radius;
    Colour colour = ink;  ///< of a dot
  };

  double width = 0, height = 0;
  Colour paper = io::paper;
  std::string title, description;
  Rings cell_rings;
  std::vector<Cell> cells;
  double wall_width = 1;  ///< of the line around each cell, in the colour of paper; 0 for no line
  Rings outline;          ///< of the domain
  double outline_width = 3;
  std::vector<Disc> discs;  ///< in drawing order
  double disc_line = 1;     ///< width of the rings
  LegendScene legend;
  double stripes = 10;         ///< distance of those of striped cells
  bool has_stripes = false;    ///< some cells are striped
  double units_per_inch = 96;  ///< of a page
};

/// The picture of a diagram on a polygon, by its style.
Scene make_scene(const DiagramOutput& output);

}  // namespace powercell::io
