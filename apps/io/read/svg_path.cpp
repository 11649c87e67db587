// The grammar of SVG path data and transforms.
#include "apps/io/read/svg_path.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

namespace powercell::io {
namespace {

bool separator(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == ',';
}

// Numbers may follow each other without a blank ("1.5.5-3"), and so may flags of arcs ("01").
class Numbers {
 public:
  explicit Numbers(std::string_view text) : text_(text) {}

  char peek() {
    while (at_ < text_.size() && separator(text_[at_])) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool at_end() { return peek(), at_ == text_.size(); }
  bool at_number() {
    const char c = peek();
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
  }
  char command() { return peek(), text_[at_++]; }
  double number() {
    peek();
    const std::size_t begin = at_ < text_.size() && text_[at_] == '+' ? at_ + 1 : at_;
    double value = 0;
    const auto [end, code] = std::from_chars(text_.data() + begin, text_.data() + text_.size(), value);
    if (code == std::errc::invalid_argument || !std::isfinite(value)) {
      throw SvgError(fmt::format("a number is expected at character {}", at_));
    }
    if (code == std::errc::result_out_of_range)
      throw SvgError(fmt::format("the number at character {} is out of range", at_));
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }
  bool flag() {
    const char c = peek();
    if (c != '0' && c != '1')
      throw SvgError(fmt::format("a flag (0 or 1) of an arc is expected at character {}", at_));
    ++at_;
    return c == '1';
  }
  std::size_t at() const { return at_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

// Follows the commands of a path. Every subpath is closed, since the domain is the filled area.
class PathReader {
 public:
  explicit PathReader(std::string_view d) : numbers_(d) {}

  std::vector<SvgOutline> read() {
    while (!numbers_.at_end()) {
      const char command = numbers_.command();
      if (outlines_.empty() && command != 'M' && command != 'm')
        throw SvgError("path data do not begin with M");
      if (command == 'Z' || command == 'z') {
        here_ = outlines_.back().start;
        begin(here_);
        continue;
      }
      char repeated = command;
      do {
        draw(repeated);
        if (repeated == 'M') repeated = 'L';
        if (repeated == 'm') repeated = 'l';
      } while (numbers_.at_number());
    }
    std::erase_if(outlines_, [](const SvgOutline& outline) { return outline.pieces.empty(); });
    return std::move(outlines_);
  }

 private:
  void begin(const SvgPoint& p) {
    outlines_.push_back({p, {}});
    here_ = p;
    reflect_cubic_ = reflect_quadratic_ = p;
  }
  SvgPoint point(bool relative) {
    const double x = numbers_.number(), y = numbers_.number();
    return relative ? SvgPoint{here_[0] + x, here_[1] + y} : SvgPoint{x, y};
  }
  void line(const SvgPoint& p) {
    outlines_.back().line_to(p);
    here_ = reflect_cubic_ = reflect_quadratic_ = p;
  }
  void cubic(const SvgPoint& c1, const SvgPoint& c2, const SvgPoint& p) {
    outlines_.back().curve_to(c1, c2, p);
    here_ = reflect_quadratic_ = p;
    reflect_cubic_ = {2 * p[0] - c2[0], 2 * p[1] - c2[1]};
  }
  void quadratic(const SvgPoint& c, const SvgPoint& p) {
    const auto third = [&](const SvgPoint& end) {
      return SvgPoint{end[0] + 2.0 / 3 * (c[0] - end[0]), end[1] + 2.0 / 3 * (c[1] - end[1])};
    };
    outlines_.back().curve_to(third(here_), third(p), p);
    here_ = reflect_cubic_ = p;
    reflect_quadratic_ = {2 * p[0] - c[0], 2 * p[1] - c[1]};
  }
  void arc(bool relative) {
    const double rx = numbers_.number(), ry = numbers_.number(), rotation = numbers_.number();
    const bool large = numbers_.flag(), sweep = numbers_.flag();
    const SvgPoint p = point(relative);
    add_svg_arc(outlines_.back(), rx, ry, rotation, large, sweep, p);
    here_ = reflect_cubic_ = reflect_quadratic_ = p;
  }

  void draw(char command) {
    const bool relative = command >= 'a';
    switch (command) {
      case 'M':
      case 'm':
        return begin(point(relative));
      case 'L':
      case 'l':
        return line(point(relative));
      case 'H':
      case 'h':
        return line({numbers_.number() + (relative ? here_[0] : 0), here_[1]});
      case 'V':
      case 'v':
        return line({here_[0], numbers_.number() + (relative ? here_[1] : 0)});
      case 'C':
      case 'c': {
        const SvgPoint c1 = point(relative), c2 = point(relative);
        return cubic(c1, c2, point(relative));
      }
      case 'S':
      case 's': {
        const SvgPoint c1 = reflect_cubic_, c2 = point(relative);
        return cubic(c1, c2, point(relative));
      }
      case 'Q':
      case 'q': {
        const SvgPoint c = point(relative);
        return quadratic(c, point(relative));
      }
      case 'T':
      case 't': {
        const SvgPoint c = reflect_quadratic_;
        return quadratic(c, point(relative));
      }
      case 'A':
      case 'a':
        return arc(relative);
      default:
        throw SvgError(fmt::format("character {} of the path data is not a command", numbers_.at() - 1));
    }
  }

  Numbers numbers_;
  std::vector<SvgOutline> outlines_;
  SvgPoint here_{};
  SvgPoint reflect_cubic_{}, reflect_quadratic_{};  // the first control points of S and T
};

SvgTransform one_transform(std::string_view name, const std::vector<double>& v) {
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
  const std::size_t n = v.size();
  if (name == "matrix" && n == 6) return {v[0], v[1], v[2], v[3], v[4], v[5]};
  if (name == "translate" && (n == 1 || n == 2)) return {1, 0, 0, 1, v[0], n == 2 ? v[1] : 0};
  if (name == "scale" && (n == 1 || n == 2)) return {v[0], 0, 0, n == 2 ? v[1] : v[0], 0, 0};
  if (name == "skewX" && n == 1) return {1, 0, std::tan(radians(v[0])), 1, 0, 0};
  if (name == "skewY" && n == 1) return {1, std::tan(radians(v[0])), 0, 1, 0, 0};
  if (name == "rotate" && (n == 1 || n == 3)) {
    const double c = std::cos(radians(v[0])), s = std::sin(radians(v[0]));
    const SvgTransform turn{c, s, -s, c, 0, 0};
    if (n == 1) return turn;
    return SvgTransform{1, 0, 0, 1, v[1], v[2]} * turn * SvgTransform{1, 0, 0, 1, -v[1], -v[2]};
  }
  throw SvgError(fmt::format("'{}' with {} numbers is not a transform", std::string(name.substr(0, 40)), n));
}

}  // namespace

std::vector<SvgOutline> parse_svg_path(std::string_view d) {
  return PathReader(d).read();
}

std::vector<double> parse_svg_numbers(std::string_view text) {
  Numbers numbers(text);
  std::vector<double> values;
  while (!numbers.at_end()) values.push_back(numbers.number());
  return values;
}

SvgTransform parse_svg_transform(std::string_view text) {
  SvgTransform all;
  std::size_t at = 0;
  while (at < text.size()) {
    if (separator(text[at])) {
      ++at;
      continue;
    }
    const std::size_t open = text.find('(', at), close = text.find(')', at);
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
      throw SvgError("the transform's parentheses do not close");
    }
    std::string_view name = text.substr(at, open - at);
    while (!name.empty() && separator(name.back())) name.remove_suffix(1);
    all = all * one_transform(name, parse_svg_numbers(text.substr(open + 1, close - open - 1)));
    at = close + 1;
  }
  return all;
}

}  // namespace powercell::io
