#include "apps/io/picture/text.hpp"

#include <cairo.h>

#include <memory>

namespace powercell::io {
namespace {

void move_to_start(cairo_t* to, const std::string& text, double x, double y, double share) {
  cairo_text_extents_t extents;
  cairo_text_extents(to, text.c_str(), &extents);
  cairo_font_extents_t lines;
  cairo_font_extents(to, &lines);
  cairo_move_to(to, x - share * extents.x_advance, y + (lines.ascent - lines.descent) / 2);
}

}  // namespace

void select_font(cairo_t* to, bool bold, double size) {
  cairo_select_font_face(to, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(to, size);
  // Letters as wide and high as text_width and label heights have them: hinting rounds both to whole pixels.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_set_font_options(to, options);
  cairo_font_options_destroy(options);
}

double text_width(const std::string& text, bool bold) {
  struct Measure {
    std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface{
        cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), cairo_surface_destroy};
    std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context{cairo_create(surface.get()), cairo_destroy};
  };
  static const Measure measure;
  constexpr double em = 100;
  select_font(measure.context.get(), bold, em);
  cairo_text_extents_t extents;
  cairo_text_extents(measure.context.get(), text.c_str(), &extents);
  return extents.x_advance / em;
}

std::string shortened(const std::string& text, double most, bool bold) {
  if (text_width(text, bold) <= most) return text;
  std::string part = text;
  while (!part.empty()) {
    while ((part.back() & 0xc0) == 0x80) part.pop_back();  // the rest of a character
    part.pop_back();
    std::string with_dots = part + "…";
    if (text_width(with_dots, bold) <= most) return with_dots;
  }
  return "…";
}

void show_text(cairo_t* to, const std::string& text, double x, double y, double share) {
  move_to_start(to, text, x, y, share);
  cairo_show_text(to, text.c_str());
}

void add_text_path(cairo_t* to, const std::string& text, double x, double y, double share) {
  move_to_start(to, text, x, y, share);
  cairo_text_path(to, text.c_str());
}

}  // namespace powercell::io
