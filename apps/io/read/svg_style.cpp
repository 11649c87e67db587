// Style sheets of SVG files: the part of CSS that determines which shapes are drawn and how they are filled.
// Drawing programs write classes (Illustrator) or attributes `style` (Inkscape). Everything else is refused
// if it could change an area, and ignored otherwise.
#include "apps/io/read/svg_style.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/io/read/svg_path.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

constexpr std::string_view kept_properties[] = {
    "display",   "fill-rule", "clip-path", "mask",        "mask-image", "transform", "transform-origin",
    "translate", "rotate",    "scale",     "offset-path", "d",          "x",         "y",
    "cx",        "cy",        "r",         "rx",          "ry",         "width",     "height"};
constexpr int deepest_at_rules = 8;  // of at-rules in one another

// Without comments and without <!-- and -->, which hide a sheet from very old browsers.
std::string without_comments(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("/*")) {
      at = std::min(text.find("*/", at + 2), text.size() - 2) + 2;
    } else if (rest.starts_with("<!--")) {
      at += 4;
    } else if (rest.starts_with("-->")) {
      at += 3;
    } else {
      result += text[at++];
      continue;
    }
    result += ' ';
  }
  return result;
}

// The position of the first character of `wanted` outside quotes and parentheses, or the size of the text.
std::size_t find_bare(std::string_view text, std::string_view wanted, std::size_t from = 0) {
  char quote = '\0';
  int depth = 0;
  for (std::size_t at = from; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\\') {
      ++at;
    } else if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (depth == 0 && wanted.find(c) != std::string_view::npos) {
      return at;
    } else if (c == '(') {
      ++depth;
    } else if (c == ')' && depth > 0) {
      --depth;
    }
  }
  return text.size();
}

// The brace that closes the one at `open`.
std::size_t block_end(std::string_view text, std::size_t open) {
  int depth = 1;
  for (std::size_t at = find_bare(text, "{}", open + 1); at < text.size();
       at = find_bare(text, "{}", at + 1)) {
    depth += text[at] == '{' ? 1 : -1;
    if (depth == 0) return at;
  }
  throw SvgError("a style sheet whose braces do not close");
}

// Removes the text up to and including the next `separator`, and returns it without the separator.
std::string_view take_until(std::string_view& text, std::string_view separator) {
  const std::size_t end = find_bare(text, separator);
  const std::string_view first = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return trimmed(first);
}

bool is_name(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || static_cast<unsigned char>(c) >= 0x80;
  });
}

}  // namespace

std::string_view svg_local_name(const pugi::xml_node& node) {
  const std::string_view full = node.name();
  const std::size_t colon = full.find(':');
  return colon == std::string_view::npos ? full : full.substr(colon + 1);
}

std::vector<SvgStyle::Declaration> SvgStyle::parse_declarations(std::string_view text) {
  std::vector<Declaration> declarations;
  while (!text.empty()) {
    std::string_view value = take_until(text, ";");
    const std::string property = lower_case(take_until(value, ":"));
    if (std::ranges::find(kept_properties, property) == std::end(kept_properties)) continue;
    const std::size_t mark = find_bare(value, "!");
    const bool important = mark < value.size() && lower_case(trimmed(value.substr(mark + 1))) == "important";
    value = trimmed(value.substr(0, mark));
    if (!value.empty()) declarations.push_back({property, lower_case(value), important});
  }
  return declarations;
}

void SvgStyle::add_rule(std::string_view selectors, const std::vector<Declaration>& declarations) {
  while (!selectors.empty()) {
    const std::string_view one = take_until(selectors, ",");
    const std::string_view name = one.substr(one.starts_with('.') || one.starts_with('#') ? 1 : 0);
    if (one != "*" && !is_name(name)) {
      throw SvgError(fmt::format(
          "its rule for '{}' sets {}, but only rules for a tag, a .class, an #id or * are read; give these "
          "elements a class",
          one.substr(0, 40), declarations.front().property));
    }
    const Kind kind = one == "*"             ? Kind::all
                      : one.starts_with('.') ? Kind::class_name
                      : one.starts_with('#') ? Kind::id
                                             : Kind::tag;
    rules_.push_back({kind, std::string(name), declarations});
  }
}

// `condition`: the at-rule around the sheet, or empty.
void SvgStyle::add(std::string_view sheet, std::string_view condition, int depth) {
  if (depth > deepest_at_rules) throw SvgError("a style sheet that is nested too deeply");
  const std::string text = without_comments(sheet);
  for (std::string_view rest = trimmed(text); !rest.empty(); rest = trimmed(rest)) {
    const std::size_t stop = find_bare(rest, "{;");
    const std::string_view first = trimmed(rest.substr(0, stop));
    const std::string word = lower_case(first.substr(0, first.find_first_of(" \t\r\n(\"'")));
    if (word.starts_with('@') && stop < rest.size() && rest[stop] == ';') {
      if (word == "@import")
        throw SvgError("@import is not read; replace it by the rules, or remove it if it only imports fonts");
      rest.remove_prefix(stop + 1);
      continue;
    }
    const std::size_t open = find_bare(rest, "{", stop);
    if (open == rest.size())
      throw SvgError(fmt::format("a style sheet that ends with '{}'", rest.substr(0, 40)));
    const std::size_t close = block_end(rest, open);
    const std::string_view selectors = trimmed(rest.substr(0, open)),
                           body = rest.substr(open + 1, close - open - 1);
    rest.remove_prefix(close + 1);
    if (word == "@font-face" || word == "@page" || word.ends_with("keyframes")) continue;
    if (selectors.starts_with('@')) {
      add(body, selectors, depth + 1);
      continue;
    }
    if (find_bare(body, "{") < body.size())
      throw SvgError("rules inside rules of a style sheet are not read");
    const std::vector<Declaration> declarations = parse_declarations(body);
    if (declarations.empty()) continue;
    if (!condition.empty()) {
      throw SvgError(fmt::format("{} in '{}' depends on where the drawing is shown; remove the condition",
                                 declarations.front().property, condition.substr(0, 40)));
    }
    add_rule(selectors, declarations);
  }
}

bool SvgStyle::applies(const Rule& rule, const pugi::xml_node& node) {
  switch (rule.kind) {
    case Kind::tag:
      return svg_local_name(node) == rule.name;
    case Kind::id:
      return node.attribute("id").value() == rule.name;
    case Kind::class_name: {
      std::string_view classes = node.attribute("class").value(), one;
      while (next_word(classes, one)) {
        if (one == rule.name) return true;
      }
      return false;
    }
    default:
      return true;
  }
}

SvgProperties SvgStyle::of(const pugi::xml_node& node) const {
  SvgProperties properties;
  std::map<std::string, std::pair<bool, Kind>> precedence;
  const auto take = [&](const std::vector<Declaration>& declarations, Kind kind) {
    for (const Declaration& one : declarations) {
      const std::pair rank(one.important, kind);
      const auto [held, fresh] = precedence.try_emplace(one.property, rank);
      if (!fresh && rank < held->second) continue;  // the last of equals wins
      held->second = rank;
      properties[one.property] = one.value;
    }
  };
  for (const Rule& rule : rules_) {
    if (applies(rule, node)) take(rule.declarations, rule.kind);
  }
  const pugi::xml_attribute style = node.attribute("style");
  if (style) take(parse_declarations(without_comments(style.value())), Kind::style_attribute);
  return properties;
}

}  // namespace powercell::io
