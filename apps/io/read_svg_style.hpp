/// \file
/// What CSS says of the elements of an SVG file, as far as it decides what they cover.
#pragma once

#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

/// The name of an element without its prefix: "path" of "svg:path".
std::string_view svg_local_name(const pugi::xml_node& node);

/// Values by the names of their properties.
using SvgProperties = std::map<std::string, std::string, std::less<>>;

/// The style sheets of a file. Of all properties only those that decide what an element covers are kept:
/// display, fill-rule, clip-path, mask, transforms, and coordinates and lengths of shapes.
class SvgStyle {
 public:
  /// Adds the rules of a sheet. Selectors are read if they name a tag, a .class, an #id or all (*), or are a
  /// list of these; others may not set a property that is kept. \throw SvgError
  void add(std::string_view sheet) { add(sheet, {}, 0); }

  /// What the sheets and the attribute `style` give an element, by CSS's precedence. Presentation attributes
  /// are not among them: they count where nothing is given here.
  SvgProperties of(const pugi::xml_node& node) const;

 private:
  struct Declaration {
    std::string property, value;
    bool important;
  };
  /// In ascending precedence.
  enum class Kind { all, tag, class_name, id, style_attribute };
  struct Rule {
    Kind kind;
    std::string name;
    std::vector<Declaration> declarations;
  };

  static std::vector<Declaration> parse_declarations(std::string_view text);
  static bool applies(const Rule& rule, const pugi::xml_node& node);
  void add(std::string_view sheet, std::string_view condition, int depth);
  void add_rule(std::string_view selectors, const std::vector<Declaration>& declarations);

  std::vector<Rule> rules_;  // in the order of the file
};

}  // namespace powercell::io
