// SVG: the shapes of a drawing as one domain.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <pugixml.hpp>

#include "apps/io/read_file.hpp"
#include "apps/io/read_polygons.hpp"
#include "apps/io/read_svg_fill.hpp"
#include "apps/io/read_svg_path.hpp"
#include "apps/io/read_text.hpp"

namespace powercell::io {
namespace {

struct Shape {
  std::vector<SvgOutline> outlines;
  bool even_odd;
};

class SvgReader {
 public:
  SvgReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}
  std::vector<PolygonPart> read();

 private:
  void element(const pugi::xml_node& node, const SvgTransform& outer, bool even_odd, int depth);
  std::vector<SvgOutline> outlines(const pugi::xml_node& node, std::string_view tag);
  std::vector<SvgOutline> rounded_rectangle(const pugi::xml_node& node);
  std::vector<SvgOutline> points(const pugi::xml_node& node);
  double length(const pugi::xml_node& node, const char* attribute, double missing = 0);
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const {
    fail_line(name_,
              line_of(text_, static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, node.offset_debug()))),
              fmt::format("<{}>: {}", node.name(), what));
  }

  std::string_view text_;
  std::string name_;
  std::vector<Shape> shapes_;
};

std::string_view local_name(const char* name) {
  const std::string_view full = name;
  const std::size_t colon = full.find(':');
  return colon == std::string_view::npos ? full : full.substr(colon + 1);
}

// The value of a property, from `style` or from the attribute of its name.
std::string property(const pugi::xml_node& node, std::string_view key) {
  const std::string_view style = node.attribute("style").value();
  for (std::size_t at = 0; at < style.size();) {
    const std::size_t end = std::min(style.find(';', at), style.size());
    const std::string_view one = style.substr(at, end - at);
    const std::size_t colon = one.find(':');
    if (colon != std::string_view::npos && trimmed(one.substr(0, colon)) == key)
      return std::string(trimmed(one.substr(colon + 1)));
    at = end + 1;
  }
  return node.attribute(std::string(key).c_str()).value();
}

double SvgReader::length(const pugi::xml_node& node, const char* attribute, double missing) {
  std::string_view value = trimmed(node.attribute(attribute).value());
  if (value.empty()) return missing;
  if (value.ends_with("px")) value.remove_suffix(2);
  double number = 0;
  if (parse_number(value, number) != Parsed::ok) {
    fail(node, fmt::format("{}='{}' is not a number of user units (no units but px are read)", attribute,
                           value.substr(0, 40)));
  }
  return number;
}

std::vector<SvgOutline> SvgReader::rounded_rectangle(const pugi::xml_node& node) {
  const double x = length(node, "x"), y = length(node, "y"), w = length(node, "width"),
               h = length(node, "height");
  if (w < 0 || h < 0) fail(node, "a negative width or height");
  if (w == 0 || h == 0) return {};
  double rx = length(node, "rx", -1), ry = length(node, "ry", -1);
  if (rx < 0) rx = std::max(ry, 0.0);
  if (ry < 0) ry = rx;
  rx = std::min(rx, w / 2);
  ry = std::min(ry, h / 2);
  SvgOutline outline{{x + rx, y}, {}};
  const auto corner = [&](const SvgPoint& before, const SvgPoint& after) {
    outline.line_to(before);
    if (rx > 0 && ry > 0) add_svg_arc(outline, rx, ry, 0, false, true, after);
  };
  corner({x + w - rx, y}, {x + w, y + ry});
  corner({x + w, y + h - ry}, {x + w - rx, y + h});
  corner({x + rx, y + h}, {x, y + h - ry});
  corner({x, y + ry}, {x + rx, y});
  return {outline};
}

std::vector<SvgOutline> SvgReader::points(const pugi::xml_node& node) {
  const std::vector<double> numbers = parse_svg_numbers(node.attribute("points").value());
  if (numbers.size() % 2 != 0) fail(node, "an odd number of coordinates");
  if (numbers.empty()) return {};
  SvgOutline outline{{numbers[0], numbers[1]}, {}};
  for (std::size_t k = 2; k < numbers.size(); k += 2) outline.line_to({numbers[k], numbers[k + 1]});
  return {outline};
}

std::vector<SvgOutline> SvgReader::outlines(const pugi::xml_node& node, std::string_view tag) {
  if (tag == "path") return parse_svg_path(node.attribute("d").value());
  if (tag == "polygon" || tag == "polyline") return points(node);
  if (tag == "rect") return rounded_rectangle(node);
  if (tag == "circle" || tag == "ellipse") {
    const double cx = length(node, "cx"), cy = length(node, "cy");
    const double rx = length(node, tag == "circle" ? "r" : "rx"),
                 ry = length(node, tag == "circle" ? "r" : "ry");
    if (rx < 0 || ry < 0) fail(node, "a negative radius");
    if (rx == 0 || ry == 0) return {};
    SvgOutline outline{{cx + rx, cy}, {}};
    add_svg_arc(outline, rx, ry, 0, false, true, {cx - rx, cy});
    add_svg_arc(outline, rx, ry, 0, false, true, {cx + rx, cy});
    return {outline};
  }
  if (tag == "use") fail(node, "is not read; put the shape itself in its place");
  return {};
}

void SvgReader::element(const pugi::xml_node& node, const SvgTransform& outer, bool even_odd, int depth) {
  if (depth > 256) fail(node, "is nested too deeply");
  const std::string_view tag = local_name(node.name());
  for (const char* unseen :
       {"defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "style", "script", "text"}) {
    if (tag == unseen) return;
  }
  if (property(node, "display") == "none") return;
  try {
    SvgTransform here = outer * parse_svg_transform(node.attribute("transform").value());
    if (tag == "svg" && depth > 0) {
      if (node.attribute("viewBox"))
        fail(node, "a drawing with its own viewBox inside the drawing is not read; take it out");
      here = here * SvgTransform{1, 0, 0, 1, length(node, "x"), length(node, "y")};
    }
    const std::string rule = property(node, "fill-rule");
    if (!rule.empty()) even_odd = rule == "evenodd";
    Shape shape{outlines(node, tag), even_odd};
    for (SvgOutline& outline : shape.outlines) transform(outline, here);
    if (!shape.outlines.empty()) shapes_.push_back(std::move(shape));
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_element) element(child, here, even_odd, depth + 1);
    }
  } catch (const SvgError& error) {
    fail(node, error.what());
  }
}

// Length of the diagonal of the box of all control points; infinite if one of them is not finite.
double diagonal(const std::vector<Shape>& shapes) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  SvgPoint low{kFar, kFar}, high{-kFar, -kFar};
  bool finite = true;  // a NaN would pass the comparisons below unseen
  const auto take = [&](const SvgPoint& p) {
    finite = finite && std::isfinite(p[0]) && std::isfinite(p[1]);
    for (int axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  };
  for (const Shape& shape : shapes) {
    for (const SvgOutline& outline : shape.outlines) {
      take(outline.start);
      for (const SvgOutline::Piece& piece : outline.pieces)
        take(piece.control1), take(piece.control2), take(piece.end);
    }
  }
  if (!finite) return kFar;
  return std::hypot(high[0] - low[0], high[1] - low[1]);
}

std::vector<PolygonPart> SvgReader::read() {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text_.data(), text_.size());
  if (!result) {
    fail_line(
        name_, line_of(text_, static_cast<std::size_t>(result.offset)),
        fmt::format("is not well-formed XML: {}; the file is truncated or damaged", result.description()));
  }
  const pugi::xml_node root = document.document_element();
  if (local_name(root.name()) != "svg") fail_line(name_, 1, "its outermost element is not <svg>");
  element(root, SvgTransform{1, 0, 0, -1, 0, 0}, false, 0);  // y up
  if (shapes_.empty()) fail_file(name_, "holds no path, polygon, polyline, rect, circle or ellipse");

  const double size = diagonal(shapes_);
  if (!std::isfinite(size)) fail_file(name_, "its coordinates are out of range once transformed");
  std::vector<std::vector<PolygonPart>> groups;
  for (const Shape& shape : shapes_) {
    std::vector<Ring> rings;
    for (const SvgOutline& outline : shape.outlines) rings.push_back(flatten(outline, kSvgTolerance * size));
    std::vector<PolygonPart> parts = fill(rings, shape.even_odd, name_);
    if (!parts.empty()) groups.push_back(std::move(parts));
  }
  if (groups.empty()) fail_file(name_, "its shapes have no area");
  return unite(groups, name_);
}

}  // namespace

std::vector<PolygonPart> parse_svg(std::string_view text, const std::string& name) {
  return SvgReader(text, name).read();
}

}  // namespace powercell::io
