/// \file
/// The legend of a picture as shapes, to be drawn as SVG text or by cairo.
#pragma once

#include <string>
#include <vector>

#include "apps/io/picture/colouring.hpp"

using cairo_t = struct _cairo;  // NOLINT(bugprone-reserved-identifier): Cairo's name

namespace powercell::io {

/// Everything in pixels, y downwards. Empty: no width.
struct LegendScene {
  struct Text {
    double x, y;  ///< left end, middle line
    double size;  ///< of an em
    double width;
    bool bold;
    std::string text;
  };
  struct Box {
    Legend::Mark mark;
    Colour colour;
    double x, y, side;  ///< upper left corner
  };
  struct Bar {
    double x = 0, y = 0, width = 0, height = 0;
    std::vector<Colour> stops;  ///< from the bottom up, at equal distances; empty: no bar
  };
  struct Tick {
    double x, y, length;  ///< to the right
  };
  double width = 0, height = 0;
  double line = 1;  ///< width of lines
  Bar bar;
  std::vector<Tick> ticks;
  std::vector<Box> boxes;
  std::vector<Text> texts;

  bool empty() const { return width <= 0; }
  void move(double x, double y);
};

/// At most half as wide as the picture and as high: its text is smaller if there is much of it. The upper
/// left corner is at 0, 0.
/// \param width  of the picture
/// \param height  of the picture, or its largest
LegendScene lay_out(const Legend& legend, double width, double height);

void draw_legend(cairo_t* to, const LegendScene& scene);
/// A group with everything that the legend needs; empty for an empty legend.
std::string legend_svg(const LegendScene& scene);

/// Lines at 45 degrees mark cells without a value; their distance for a picture of that longer side.
double stripe_distance(double long_side);
/// Fills the current path with them.
void fill_striped(cairo_t* to, double distance);
/// The pattern "no-value" for SVG.
std::string stripes_svg(double distance);

}  // namespace powercell::io
