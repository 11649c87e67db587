// Legends drawn by cairo and as SVG.
#include <cairo.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "apps/io/picture/cairo.hpp"
#include "apps/io/picture/colour_scales.hpp"
#include "apps/io/picture/legend.hpp"
#include "apps/io/picture/text.hpp"
#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

constexpr double stripe_share = 0.3;    // of their distance
constexpr double marks_in_a_box = 3.5;  // stripes

void draw_bar(cairo_t* to, const LegendScene& scene) {
  const LegendScene::Bar& bar = scene.bar;
  if (bar.stops.empty()) return;
  cairo_pattern_t* colours = cairo_pattern_create_linear(0, bar.y + bar.height, 0, bar.y);
  for (std::size_t k = 0; k < bar.stops.size(); ++k)
    cairo_pattern_add_color_stop_rgb(
        colours, static_cast<double>(k) / static_cast<double>(bar.stops.size() - 1), bar.stops[k].red / 255.0,
        bar.stops[k].green / 255.0, bar.stops[k].blue / 255.0);
  cairo_rectangle(to, bar.x, bar.y, bar.width, bar.height);
  cairo_set_source(to, colours);
  cairo_fill(to);
  cairo_pattern_destroy(colours);
  set_colour(to, ink);
  for (const LegendScene::Tick& tick : scene.ticks) {
    cairo_move_to(to, tick.x, tick.y);
    cairo_rel_line_to(to, tick.length, 0);
    cairo_stroke(to);
  }
}

void draw_box(cairo_t* to, const LegendScene::Box& box) {
  const double radius = 0.3 * box.side, x = box.x + box.side / 2, y = box.y + box.side / 2;
  switch (box.mark) {
    case Legend::Mark::colour:
      cairo_rectangle(to, box.x, box.y, box.side, box.side);
      set_colour(to, box.colour);
      cairo_fill(to);
      break;
    case Legend::Mark::no_value:
      cairo_rectangle(to, box.x, box.y, box.side, box.side);
      fill_striped(to, box.side / marks_in_a_box);
      cairo_new_path(to);
      break;
    case Legend::Mark::hidden:
      cairo_arc(to, x, y, radius, 0, 2 * std::numbers::pi);
      set_colour(to, paper);
      cairo_fill_preserve(to);
      set_colour(to, ink);
      cairo_stroke(to);
      break;
    case Legend::Mark::duplicate:
      set_colour(to, ink);
      cairo_move_to(to, x - radius, y - radius);
      cairo_line_to(to, x + radius, y + radius);
      cairo_move_to(to, x + radius, y - radius);
      cairo_line_to(to, x - radius, y + radius);
      cairo_stroke(to);
      break;
    case Legend::Mark::none:
      break;
  }
}

std::string box_svg(const LegendScene::Box& box) {
  const double radius = 0.3 * box.side, x = box.x + box.side / 2, y = box.y + box.side / 2;
  switch (box.mark) {
    case Legend::Mark::colour:
    case Legend::Mark::no_value:
      return fmt::format(
          "<rect x=\"{0:.2f}\" y=\"{1:.2f}\" width=\"{2:.2f}\" height=\"{2:.2f}\" fill=\"{3}\"/>\n", box.x,
          box.y, box.side, box.mark == Legend::Mark::colour ? hex(box.colour) : "url(#no-value-key)");
    case Legend::Mark::hidden:
      return fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" stroke=\"{}\"/>\n", x,
                         y, radius, hex(paper), hex(ink));
    case Legend::Mark::duplicate:
      return fmt::format(
          "<path d=\"M{0:.2f} {1:.2f}l{2:.2f} {2:.2f}m0-{2:.2f}l-{2:.2f} {2:.2f}\" "
          "style=\"fill:none;stroke:{3}\"/>\n",
          x - radius, y - radius, 2 * radius, hex(ink));
    case Legend::Mark::none:
      break;
  }
  return {};
}

std::string stripes(const char* id, double distance) {
  return fmt::format(
      "<pattern id=\"{0}\" patternUnits=\"userSpaceOnUse\" width=\"{1:.3g}\" height=\"{1:.3g}\" "
      "patternTransform=\"rotate(-45)\"><rect width=\"{1:.3g}\" height=\"{1:.3g}\" fill=\"{2}\"/>"
      "<rect width=\"{1:.3g}\" height=\"{3:.3g}\" fill=\"{4}\"/></pattern>\n",
      id, distance, hex(no_value), stripe_share * distance, hex(no_value_stripe));
}

std::string bar_svg(const LegendScene& scene) {
  const LegendScene::Bar& bar = scene.bar;
  if (bar.stops.empty()) return {};
  std::string text = "<linearGradient id=\"scale\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">";
  for (std::size_t k = 0; k < bar.stops.size(); ++k)
    text +=
        fmt::format("<stop offset=\"{:.5g}\" stop-color=\"{}\"/>",
                    static_cast<double>(k) / static_cast<double>(bar.stops.size() - 1), hex(bar.stops[k]));
  text += fmt::format(
      "</linearGradient>\n<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
      "fill=\"url(#scale)\"/>\n<path class=\"ticks\" style=\"fill:none;stroke:{}\" d=\"",
      bar.x, bar.y, bar.width, bar.height, hex(ink));
  for (const LegendScene::Tick& tick : scene.ticks)
    text += fmt::format("M{:.2f} {:.2f}h{:.2f}", tick.x, tick.y, tick.length);
  return text + "\"/>\n";
}

}  // namespace

void draw_legend(cairo_t* to, const LegendScene& scene) {
  if (scene.empty()) return;
  cairo_set_line_width(to, scene.line);
  cairo_set_dash(to, nullptr, 0, 0);
  draw_bar(to, scene);
  for (const LegendScene::Box& box : scene.boxes) draw_box(to, box);
  set_colour(to, ink);
  for (const LegendScene::Text& text : scene.texts) {
    select_font(to, text.bold, text.size);
    show_text(to, text.text, text.x, text.y, 0);
  }
}

std::string legend_svg(const LegendScene& scene) {
  if (scene.empty()) return {};
  std::string svg = fmt::format("<g class=\"legend\" stroke-width=\"{:.3g}\">\n", scene.line);
  svg += bar_svg(scene);
  for (const LegendScene::Box& box : scene.boxes) {
    if (box.mark == Legend::Mark::no_value) svg += stripes("no-value-key", box.side / marks_in_a_box);
    svg += box_svg(box);
  }
  // textLength keeps a text in its place with any font, and styles go before those of the whole picture.
  for (const LegendScene::Text& text : scene.texts)
    svg += fmt::format(
        "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.3g}\" textLength=\"{:.2f}\" "
        "style=\"font-family:{};font-weight:{};text-anchor:start;dominant-baseline:central;fill:{}\">{}</"
        "text>\n",
        text.x, text.y, text.size, text.width, font_families, text.bold ? "bold" : "normal", hex(ink),
        xml_text(text.text));
  return svg + "</g>\n";
}

void fill_striped(cairo_t* to, double distance) {
  cairo_save(to);
  cairo_path_t* const path = cairo_copy_path(to);
  cairo_clip_preserve(to);
  set_colour(to, no_value);
  cairo_fill(to);
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0;
  cairo_clip_extents(to, &low_x, &low_y, &high_x, &high_y);
  set_colour(to, no_value_stripe);
  cairo_set_line_width(to, stripe_share * distance);
  // Lines x + y = c, at the same places for all cells.
  const double step = distance * std::numbers::sqrt2;
  for (double c = std::floor((low_x + low_y) / step) * step; c <= high_x + high_y + step; c += step) {
    cairo_move_to(to, c - low_y + step, low_y - step);
    cairo_line_to(to, c - high_y - step, high_y + step);
    cairo_stroke(to);
  }
  cairo_restore(to);
  cairo_append_path(to, path);
  cairo_path_destroy(path);
}

std::string stripes_svg(double distance) {
  return stripes("no-value", distance);
}

}  // namespace powercell::io
