// SVG: the shapes of a drawing as one domain.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <pugixml.hpp>

#include "apps/io/read/file.hpp"
#include "apps/io/read/polygons.hpp"
#include "apps/io/read/svg_fill.hpp"
#include "apps/io/read/svg_path.hpp"
#include "apps/io/read/svg_style.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

struct Shape {
  std::vector<SvgOutline> outlines;
  bool even_odd;
};

constexpr std::size_t most_copies = 1'000'000;  // elements drawn by <use>, which may double at each level

class SvgReader {
 public:
  SvgReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}
  std::vector<PolygonPart> read();

 private:
  void read_style_sheets(const pugi::xml_document& document);
  void find_named(const pugi::xml_document& document);
  void element(const pugi::xml_node& node, const SvgTransform& outer, bool even_odd, int depth);
  void children(const pugi::xml_node& node, const SvgTransform& here, bool even_odd, int depth);
  void copy(const pugi::xml_node& use, const SvgTransform& here, bool even_odd, int depth);
  bool is_drawn(const pugi::xml_node& node) const;
  void refuse_unread(const pugi::xml_node& node, const SvgProperties& css) const;
  SvgTransform transform_of(const pugi::xml_node& node, const SvgProperties& css) const;
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
  std::string namespace_;  // of the outermost element
  SvgStyle style_;
  std::map<std::string, pugi::xml_node, std::less<>> named_;  // elements by their ids, the first of each
  std::size_t copies_ = 0;
  std::vector<Shape> shapes_;
};

// As written in the file: entities such as Illustrator's &ns_svg; are not replaced.
std::string namespace_of(const pugi::xml_node& node) {
  const std::string_view full = node.name();
  const std::size_t colon = full.find(':');
  const std::string prefix(colon == std::string_view::npos ? "" : full.substr(0, colon));
  const std::string declaration = prefix.empty() ? "xmlns" : "xmlns:" + prefix;
  for (pugi::xml_node from = node; from; from = from.parent()) {
    if (const pugi::xml_attribute found = from.attribute(declaration.c_str())) return found.value();
  }
  return prefix.empty() ? "" : "undeclared " + prefix;
}

// The value from CSS, else from the attribute; empty if neither exists or the parent's value applies.
std::string property(const pugi::xml_node& node, const SvgProperties& css, const char* key) {
  const auto given = css.find(key);
  std::string value = given != css.end() ? given->second : lower_case(trimmed(node.attribute(key).value()));
  if (value == "inherit" || value == "unset" || value == "revert") value.clear();
  return value;
}

// Whether a property that cuts or moves shapes has an effect.
bool is_set(const std::string& value) {
  return !value.empty() && value != "none" && value != "initial";
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
  return {};
}

void SvgReader::read_style_sheets(const pugi::xml_document& document) {
  if (const pugi::xml_node sheet = document.child("xml-stylesheet"))
    fail(sheet, "external style sheets are not read; put the rules into an element <style>");
  struct Collector : pugi::xml_tree_walker {  // without recursion: files may be nested deeply
    explicit Collector(SvgReader& to) : reader(to) {}
    bool for_each(pugi::xml_node& node) override {
      if (svg_local_name(node) != "style") return true;
      const std::string type = lower_case(trimmed(node.attribute("type").value()));
      if (!type.empty() && type != "text/css") return true;  // no program applies it
      const std::string media = lower_case(trimmed(node.attribute("media").value()));
      if (!media.empty() && media != "all" && media != "screen")
        reader.fail(node, "rules that depend on the medium are not read; remove the attribute media");
      std::string sheet;
      for (const pugi::xml_node& child : node.children()) sheet += child.value();  // text and CDATA
      try {
        reader.style_.add(sheet);
      } catch (const SvgError& error) {
        reader.fail(node, error.what());
      }
      return true;
    }
    SvgReader& reader;
  } collector(*this);
  pugi::xml_node whole = document;
  whole.traverse(collector);
}

void SvgReader::find_named(const pugi::xml_document& document) {
  struct Collector : pugi::xml_tree_walker {
    explicit Collector(SvgReader& to) : reader(to) {}
    bool for_each(pugi::xml_node& node) override {
      if (const pugi::xml_attribute id = node.attribute("id")) reader.named_.try_emplace(id.value(), node);
      return true;
    }
    SvgReader& reader;
  } collector(*this);
  pugi::xml_node whole = document;
  whole.traverse(collector);
}

// Whether an element and its children are drawn, as far as its name and its conditions determine.
bool SvgReader::is_drawn(const pugi::xml_node& node) const {
  const std::string of = namespace_of(node);
  if (of != namespace_ && of != "http://www.w3.org/2000/svg") return false;
  const std::string_view tag = svg_local_name(node);
  for (const char* unseen : {"defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "style",
                             "script", "text", "font", "foreignObject", "flowRoot"}) {
    if (tag == unseen) return false;
  }
  if (node.attribute("systemLanguage"))
    fail(node, "the drawing depends on the reader's language; keep one and remove systemLanguage");
  return !node.attribute("requiredExtensions");
}

// Refuses properties that would change the area but are not supported.
void SvgReader::refuse_unread(const pugi::xml_node& node, const SvgProperties& css) const {
  for (const char* cut : {"clip-path", "mask", "mask-image"}) {
    if (is_set(property(node, css, cut)))
      fail(node, fmt::format("{} is not read; cut the shapes themselves, or remove it", cut));
  }
  for (const char* move : {"translate", "rotate", "scale", "offset-path"}) {
    const auto given = css.find(move);
    if (given != css.end() && is_set(given->second))
      fail(node, fmt::format("{} in CSS is not read; write it as the attribute transform", move));
  }
  if (node.attribute("transform") && is_set(property(node, css, "transform-origin")))
    fail(node, "transform-origin is not read; write the transform with the origin 0 0");
  const std::string_view tag = svg_local_name(node);
  if (tag != "path" && tag != "rect" && tag != "circle" && tag != "ellipse" && tag != "use") return;
  for (const char* place : {"d", "x", "y", "cx", "cy", "r", "rx", "ry", "width", "height"}) {
    if (css.contains(place))
      fail(node, fmt::format("{} in CSS is not read; write it as an attribute", place));
  }
}

SvgTransform SvgReader::transform_of(const pugi::xml_node& node, const SvgProperties& css) const {
  const auto given = css.find("transform");
  if (given == css.end()) return parse_svg_transform(node.attribute("transform").value());
  if (given->second != "none")
    fail(node, "transform in CSS is not read; write it as the attribute transform");
  return {};
}

void SvgReader::children(const pugi::xml_node& node, const SvgTransform& here, bool even_odd, int depth) {
  const bool first_only = svg_local_name(node) == "switch";
  for (const pugi::xml_node& child : node.children()) {
    if (child.type() != pugi::node_element) continue;
    element(child, here, even_odd, depth + 1);
    if (first_only && namespace_of(child) == namespace_ && !child.attribute("requiredExtensions")) return;
  }
}

// The attribute `href` of SVG 2, or that of XLink under whatever prefix.
std::string_view reference_of(const pugi::xml_node& node) {
  if (const pugi::xml_attribute plain = node.attribute("href")) return trimmed(plain.value());
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    if (std::string_view(attribute.name()).ends_with(":href")) return trimmed(attribute.value());
  }
  return {};
}

// Draws the element that <use> names, moved by its x and y.
void SvgReader::copy(const pugi::xml_node& use, const SvgTransform& here, bool even_odd, int depth) {
  const std::string_view reference = reference_of(use);
  if (!reference.starts_with('#'))
    fail(use, reference.empty() ? "names no element" : "only elements of the same file can be used");
  const auto found = named_.find(reference.substr(1));
  if (found == named_.end()) fail(use, fmt::format("no element has the id '{}'", reference.substr(1, 40)));
  if (++copies_ > most_copies)
    fail(use, fmt::format("draws more than {} elements, with those drawn by others", most_copies));
  const pugi::xml_node target = found->second;
  const SvgTransform moved = here * SvgTransform{1, 0, 0, 1, length(use, "x"), length(use, "y")};
  if (svg_local_name(target) != "symbol") return element(target, moved, even_odd, depth + 1);
  if (target.attribute("viewBox"))
    fail(target, "a symbol with a viewBox is not read; remove it, and scale with the attribute transform");
  refuse_unread(target, style_.of(target));
  children(target, moved, even_odd, depth + 1);
}

void SvgReader::element(const pugi::xml_node& node, const SvgTransform& outer, bool even_odd, int depth) {
  if (depth > 256) fail(node, "is nested too deeply");
  if (!is_drawn(node)) return;
  const SvgProperties css = style_.of(node);
  if (property(node, css, "display") == "none") return;
  refuse_unread(node, css);
  const std::string_view tag = svg_local_name(node);
  try {
    SvgTransform here = outer * transform_of(node, css);
    if (tag == "svg" && depth > 0) {
      if (node.attribute("viewBox"))
        fail(node, "a nested drawing with its own viewBox is not read; remove it");
      here = here * SvgTransform{1, 0, 0, 1, length(node, "x"), length(node, "y")};
    }
    const std::string rule = property(node, css, "fill-rule");
    if (!rule.empty() && rule != "evenodd" && rule != "nonzero" && rule != "initial")
      fail(node, fmt::format("fill-rule '{}' is neither nonzero nor evenodd", rule.substr(0, 40)));
    if (!rule.empty()) even_odd = rule == "evenodd";
    Shape shape{outlines(node, tag), even_odd};
    for (SvgOutline& outline : shape.outlines) transform(outline, here);
    if (!shape.outlines.empty()) shapes_.push_back(std::move(shape));
    if (tag == "use")
      copy(node, here, even_odd, depth);
    else
      children(node, here, even_odd, depth);
  } catch (const SvgError& error) {
    fail(node, error.what());
  }
}

// Length of the diagonal of the box of all control points; infinite if one of them is not finite.
double diagonal(const std::vector<Shape>& shapes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  SvgPoint low{infinity, infinity}, high{-infinity, -infinity};
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
  if (!finite) return infinity;
  return std::hypot(high[0] - low[0], high[1] - low[1]);
}

std::vector<PolygonPart> SvgReader::read() {
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(text_.data(), text_.size(), pugi::parse_default | pugi::parse_pi);
  if (!result) {
    fail_line(
        name_, line_of(text_, static_cast<std::size_t>(result.offset)),
        fmt::format("is not well-formed XML: {}; the file is truncated or damaged", result.description()));
  }
  const pugi::xml_node root = document.document_element();
  if (svg_local_name(root) != "svg") fail_line(name_, 1, "its outermost element is not <svg>");
  namespace_ = namespace_of(root);
  read_style_sheets(document);
  find_named(document);
  element(root, SvgTransform{1, 0, 0, -1, 0, 0}, false, 0);  // y up
  if (shapes_.empty()) fail_file(name_, "holds no path, polygon, polyline, rect, circle or ellipse");

  const double size = diagonal(shapes_);
  if (!std::isfinite(size)) fail_file(name_, "its coordinates are out of range once transformed");
  std::vector<std::vector<PolygonPart>> groups;
  for (const Shape& shape : shapes_) {
    std::vector<Ring> rings;
    for (const SvgOutline& outline : shape.outlines) rings.push_back(flatten(outline, svg_tolerance * size));
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
