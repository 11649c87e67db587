#include "apps/bench/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "apps/bench/sizes.hpp"
#include "apps/bench/table.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/io/picture/colour_scales.hpp"
#include "apps/io/picture/round_ticks.hpp"
#include "apps/io/picture/text.hpp"
#include "apps/io/printable.hpp"

namespace powercell::app {
namespace {

using io::hex;
using io::ink;

// Everything in pixels, y downwards.
constexpr double width = 1100, margin = 24, line = 20, text_size = 12, axis_room = 44;
constexpr double names_end = 236, rows_end = 620, transfers_start = 712, transfers_height = 320;
constexpr io::Colour grid{0xdd, 0xe1, 0xe6}, faint{0x6b, 0x77, 0x85};

struct Extent {
  double low = 1e300, high = 0;
  void add(double value) {
    if (!(value > 0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// A logarithmic scale from one place on the picture to another.
class Scale {
 public:
  Scale(const Extent& values, double base, double from, double to)
      : base_(base),
        first_(std::floor(log(values.low) + 1e-9)),
        last_(std::max(first_ + 1, std::ceil(log(values.high) - 1e-9))),
        from_(from),
        to_(to) {}

  double at(double value) const { return from_ + (to_ - from_) * (log(value) - first_) / (last_ - first_); }
  /// The powers of the base.
  std::vector<double> ticks() const {
    std::vector<double> ticks;
    for (double k = first_; k <= last_; ++k) ticks.push_back(std::pow(base_, k));
    return ticks;
  }

 private:
  double log(double value) const { return std::log(value) / std::log(base_); }

  double base_, first_, last_, from_, to_;
};

enum class Side { left, middle, right };

struct Style {
  io::Colour colour = ink;
  Side side = Side::left;  // of the text that lies at the place
  bool bold = false;
};

std::string text_at(double x, double y, const std::string& text, const Style& style = {}) {
  const char* anchor = style.side == Side::left ? "start" : style.side == Side::middle ? "middle" : "end";
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n", x, y,
                     anchor, hex(style.colour), style.bold ? " font-weight=\"bold\"" : "",
                     io::xml_text(io::printable(text)));
}

std::string line_from(double x, double y, double to_x, double to_y, io::Colour colour, double thick) {
  return fmt::format(
      "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n", x, y,
      to_x, to_y, hex(colour), thick);
}

// A figure, and the whisker from it back to the lower quartile. \param hollow  of the second kind
std::string dot(double x, double y, double back, io::Colour colour, bool hollow) {
  return line_from(back, y, x, y, colour, 2) +
         fmt::format(
             "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.5\"/>\n",
             x, y, hex(hollow ? io::paper : colour), hex(colour));
}

class Plot {
 public:
  explicit Plot(const BenchRecord& record) : record_(record) {
    const std::vector<io::Colour> colours =
        io::class_colours(std::clamp<std::size_t>(record.devices.size(), 1, io::most_classes));
    for (std::size_t k = 0; k < record.devices.size(); ++k)
      colour_[record.devices[k].info.selector()] = colours[k % colours.size()];
    for (const BenchRow& row : record.rows) {
      if (!row.failure.empty()) continue;
      const Key key{row.domain, row.precision, row.n};
      if (std::find(keys_.begin(), keys_.end(), key) == keys_.end()) keys_.push_back(key);
    }
  }

  std::string svg() {
    std::string body = head();
    const double top = y_ + line;
    body += rows(top) + transfers(top);
    const double height =
        std::max(top + line * static_cast<double>(keys_.size()), top + transfers_height) + axis_room + margin;
    return fmt::format(
               "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
               "width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\" "
               "font-family=\"{2}\" font-size=\"{3}\">\n<title>powercell bench</title>\n"
               "<rect width=\"100%\" height=\"100%\" fill=\"{4}\"/>\n",
               width, height, io::font_families, text_size, hex(io::paper)) +
           body + "</svg>\n";
  }

 private:
  using Key = std::tuple<std::string, std::string, std::size_t>;

  // What was measured, and a line for each device with its colour and rates.
  std::string head() {
    y_ = margin + line / 2;
    std::string text = text_at(margin, y_, "powercell bench", {ink, Side::left, true});
    text += text_at(width - margin, y_,
                    fmt::format("powercell {} {}, {}", version(), record_.revision, record_.date),
                    {faint, Side::right});
    for (const BenchDevice& device : record_.devices) {
      y_ += line;
      const io::Colour colour = colour_[device.info.selector()];
      text += dot(margin + 4, y_ - 4, margin + 4, colour, false);
      std::string what = device.info.name;
      for (const BenchRates& measured : device.rates)
        what += fmt::format("; {}: {:.3g} Gflop/s {}, {:.3g} GB/s {}", measured.precision,
                            1e-9 * measured.rates.operations, scatter_text(measured.rates.operations_scatter),
                            1e-9 * measured.rates.copied_bytes, scatter_text(measured.rates.copied_scatter));
      text += text_at(margin + 16, y_, io::shortened(what, (width - 2 * margin - 16) / text_size, false));
    }
    if (!record_.description.empty()) {
      y_ += line;
      text += text_at(margin, y_, io::shortened(io::one_line(record_.description), 85, false), {faint});
    }
    y_ += line;
    return text;
  }

  std::string rows(double top) {
    if (keys_.empty()) return {};
    Extent rates;
    for (const BenchRow& row : record_.rows)
      if (row.failure.empty()) {
        rates.add(row.adjacency_rate() / (1 + row.adjacency.scatter()));
        rates.add(row.rate());
      }
    const Scale scale(rates, 10, names_end, rows_end);
    const double bottom = top + line * static_cast<double>(keys_.size());
    std::string text;
    for (const double tick : scale.ticks()) {
      text += line_from(scale.at(tick), top - line / 2, scale.at(tick), bottom, grid, 1);
      text += text_at(scale.at(tick), bottom + line,
                      "10" + io::power_of_ten(static_cast<int>(std::lround(std::log10(tick)))).substr(4),
                      {faint, Side::middle});
    }
    text += text_at((names_end + rows_end) / 2, bottom + 2 * line,
                    "cells a second: ● measures, ○ with adjacency", {ink, Side::middle});
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      const double y = top + line * static_cast<double>(k);
      const auto& [domain, precision, n] = keys_[k];
      text += line_from(names_end, y, rows_end, y, grid, 1);
      text +=
          text_at(names_end - 8, y + 4,
                  fmt::format("{}, {}, {}", io::shortened(domain, 8, false), precision, io::with_commas(n)),
                  {ink, Side::right});
      for (const BenchRow& row : record_.rows)
        if (row.failure.empty() && Key{row.domain, row.precision, row.n} == keys_[k])
          text += dots(row, y, scale);
    }
    return text;
  }

  std::string dots(const BenchRow& row, double y, const Scale& scale) {
    const io::Colour colour = colour_[row.selector];
    const auto one = [&](double rate, const TimedRuns& runs, bool hollow) {
      return dot(scale.at(rate), y, scale.at(rate / (1 + runs.scatter())), colour, hollow);
    };
    return one(row.adjacency_rate(), row.adjacency, true) + one(row.rate(), row.measures, false);
  }

  std::string transfers(double top) {
    Extent sizes, rates;
    for (const BenchDevice& device : record_.devices)
      for (const BenchTransfers& measured : device.transfers) {
        sizes.add(static_cast<double>(measured.bytes));
        for (const double rate : {measured.rates.to_device, measured.rates.to_host}) rates.add(1e-9 * rate);
      }
    if (rates.high == 0) return {};
    top -= line / 2;
    const double bottom = top + transfers_height, end = width - margin - 12;
    const Scale across(sizes, 4, transfers_start, end), up(rates, 10, bottom, top);
    std::string text;
    bool named = false;  // every second, as there is room for
    for (const double tick : across.ticks()) {
      text += line_from(across.at(tick), top, across.at(tick), bottom, grid, 1);
      if ((named = !named))
        text += text_at(across.at(tick), bottom + line,
                        bytes_text(static_cast<std::size_t>(std::llround(tick))), {faint, Side::middle});
    }
    for (const double tick : up.ticks()) {
      text += line_from(transfers_start, up.at(tick), end, up.at(tick), grid, 1);
      text += text_at(transfers_start - 8, up.at(tick) + 4, fmt::format("{:g}", tick), {faint, Side::right});
    }
    text += text_at((transfers_start + end) / 2, bottom + 2 * line,
                    "transfers, GB/s: ● to the device, ○ to the host", {ink, Side::middle});
    for (const BenchDevice& device : record_.devices) text += curves(device, across, up);
    return text;
  }

  std::string curves(const BenchDevice& device, const Scale& across, const Scale& up) {
    const io::Colour colour = colour_[device.info.selector()];
    std::string text;
    for (const bool to_host : {true, false}) {
      std::string path, marks;
      for (const BenchTransfers& measured : device.transfers) {
        const double x = across.at(static_cast<double>(measured.bytes)),
                     y = up.at(1e-9 * (to_host ? measured.rates.to_host : measured.rates.to_device));
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', x, y);
        marks += dot(x, y, x, colour, to_host);
      }
      text += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n{}", path,
                          hex(colour), to_host ? " stroke-dasharray=\"5 3\"" : "", marks);
    }
    return text;
  }

  const BenchRecord& record_;
  std::map<std::string, io::Colour> colour_;  // by selector
  std::vector<Key> keys_;                     // rows of any device, in order
  double y_ = 0;
};

}  // namespace

std::string plot_svg(const BenchRecord& record) {
  return Plot(record).svg();
}

void write_plot(const std::string& path, const BenchRecord& record) {
  io::AtomicFile file(path);
  file.write(plot_svg(record));
  file.commit();
}

}  // namespace powercell::app
