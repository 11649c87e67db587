/// \file
/// Pictures and pages drawn with cairo.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/io/picture/scene.hpp"

using cairo_t = struct _cairo;  // NOLINT(bugprone-reserved-identifier): Cairo's name

namespace powercell::io {

/// Draws in pixels, y downwards. The context keeps a failure, which is reported when the picture is written.
using Painter = std::function<void(cairo_t*)>;

void set_colour(cairo_t* to, Colour colour, double opacity = 1);

struct PageText {
  const std::string& title;
  const std::string& description;
};

/// Writes what the painter draws on a picture of that size in pixels.
/// \throw Error write_failed
void paint_png(const std::string& path, double width, double height, const Painter& paint);
void paint_pdf(const std::string& path, double width, double height, const PageText& text,
               const Painter& paint, double units_per_inch = 96);

/// Draws a flat picture as PNG or PDF.
/// \throw Error write_failed
void draw_png(const std::string& path, const Scene& scene);
void draw_pdf(const std::string& path, const Scene& scene);

/// Nothing is owned.
struct Pixels {
  const std::vector<std::uint8_t>& rgb;  ///< height x width x 3, row-major, from the top
  int width, height;
};
/// White paper with the pixels at a place, and what is drawn over them.
struct PixelCanvas {
  int width, height, left = 0, top = 0;
  Painter over = {};
};
/// Writes a PNG.
/// \pre the pixels lie on the canvas
/// \throw Error write_failed
void write_pixels(const std::string& path, const Pixels& pixels, const PixelCanvas& canvas);

}  // namespace powercell::io
