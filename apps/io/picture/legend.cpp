#include "apps/io/picture/legend.hpp"

#include <algorithm>
#include <cmath>

#include "apps/io/picture/colour_scales.hpp"
#include "apps/io/picture/round_ticks.hpp"
#include "apps/io/picture/text.hpp"

namespace powercell::io {
namespace {

constexpr double row_height = 1.6;  // all in ems
constexpr double longest_entry = 16;
constexpr double legend_padding = 1.2;
constexpr std::size_t gradient_stops = 33;  // between which a gradient is straight

class LegendLayout {
 public:
  LegendLayout(const Legend& legend, double em, double most_height) : legend_(legend), em_(em) {
    scene_.line = std::max(0.5, 0.06 * em);
    rows_ = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::max(0.0, most_height / em - 2 * legend_padding - title_height()) /
                                    row_height));
  }

  LegendScene run() {
    const double bar = bar_height();
    if (legend_.scale) {
      constexpr double between_ticks = 1.3;
      const int most = std::clamp(static_cast<int>(bar / between_ticks), 3, 7);
      ticks_ = round_ticks(legend_.low, legend_.high, legend_.whole, most);
    }
    if (!legend_.title.empty()) add_title();
    if (legend_.scale) add_bar(bar);
    add_entries();
    scene_.width = (right_ + legend_padding) * em_;
    scene_.height = (bottom_ + legend_padding) * em_;
    return std::move(scene_);
  }

 private:
  double title_height() const { return legend_.title.empty() ? 0 : 2.0; }

  /// What the entries leave, within limits.
  double bar_height() const {
    const double rows = static_cast<double>(rows_) - static_cast<double>(legend_.entries.size());
    return std::clamp(rows * row_height - 0.8, 4.0, 14.0);
  }

  double add_text(double x, double y, const std::string& text, bool bold, double size = 1) {
    const double width = size * text_width(text, bold);
    scene_.texts.push_back({x * em_, y * em_, size * em_, width * em_, bold, text});
    right_ = std::max(right_, x + width);
    return width;
  }

  void add_title() {
    std::string title = legend_.title;
    std::string unit = legend_.unit;
    if (legend_.scale) {
      const std::string factor = power_of_ten(ticks_.exponent);
      unit = factor.empty() || unit.empty() ? factor + unit : factor + " " + unit;
    }
    if (!unit.empty()) title += " (" + unit + ")";
    add_text(0, legend_padding + 0.6, shortened(title, longest_entry, true), true);
    top_ = bottom_ = legend_padding + title_height();
  }

  void add_bar(double height) {
    constexpr double bar_width = 1.2, tick = 0.35, gap = 0.35;
    const double from_top = top_ + 0.4;
    scene_.bar = {0, from_top * em_, bar_width * em_, height * em_, {}};
    for (std::size_t k = 0; k < gradient_stops; ++k)
      scene_.bar.stops.push_back(scale_colour(static_cast<double>(k) / (gradient_stops - 1)));
    for (std::size_t k = 0; k < ticks_.at.size(); ++k) {
      const double y = from_top + height * (1 - share_of_range(ticks_.at[k], legend_.low, legend_.high));
      scene_.ticks.push_back({bar_width * em_, y * em_, tick * em_});
      add_text(bar_width + tick + gap, y, ticks_.label[k], false);
    }
    top_ = bottom_ = from_top + height + 0.9;
  }

  void add_entries() {
    constexpr double side = 1.1, gap = 0.5, between_columns = 1.5;
    // Below a bar there is room for a few rows only, which are few.
    const std::size_t rows = legend_.scale ? std::max(rows_, legend_.entries.size()) : rows_;
    double left = 0, y = top_;
    std::size_t row = 0;
    for (const Legend::Entry& entry : legend_.entries) {
      if (row == rows) {
        left = right_ + between_columns;
        y = top_;
        row = 0;
      }
      const bool box = entry.mark != Legend::Mark::none;
      if (box)
        scene_.boxes.push_back(
            {entry.mark, entry.colour, left * em_, (y + (row_height - side) / 2) * em_, side * em_});
      add_text(left + (box ? side + gap : 0), y + row_height / 2, shortened(entry.text, longest_entry, false),
               false);
      y += row_height;
      bottom_ = std::max(bottom_, y);
      ++row;
    }
  }

  const Legend& legend_;
  double em_;
  std::size_t rows_ = 1;
  LegendScene scene_;
  Ticks ticks_;
  double top_ = legend_padding, right_ = 0, bottom_ = legend_padding;
};

}  // namespace

void LegendScene::move(double x, double y) {
  bar.x += x;
  bar.y += y;
  for (Tick& tick : ticks) tick.x += x, tick.y += y;
  for (Box& box : boxes) box.x += x, box.y += y;
  for (Text& text : texts) text.x += x, text.y += y;
}

LegendScene lay_out(const Legend& legend, double width, double height) {
  if (legend.empty()) return {};
  double em = std::max(9.0, 0.0125 * std::max(width, height));
  for (;; em *= 0.93) {
    LegendScene scene = LegendLayout(legend, em, height).run();
    if ((scene.width <= width / 2 && scene.height <= height) || em < 1) return scene;
  }
}

double stripe_distance(double long_side) {
  return std::max(4.0, long_side / 160);
}

}  // namespace powercell::io
