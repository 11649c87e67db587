/// \file
/// CSS properties of SVG elements, as far as they determine the covered area.
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

/// The style sheets of a file. Only properties that determine the covered area are kept: display, fill-rule,
/// clip-path, mask, transforms, and coordinates and lengths of shapes.
class SvgStyle {
 public:
  /// Adds the rules of a sheet. Selectors may be a tag, a .class, an #id, * or a list of these; rules with
  /// other selectors must not set a kept property.
  /// \throw SvgError
  void add(std::string_view sheet) { add(sheet, {}, 0); }

  /// The properties of an element from the sheets and its attribute `style`, by CSS's precedence.
  /// Presentation attributes are not included; they apply to properties missing here.
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
