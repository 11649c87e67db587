#include "apps/io/tables/column_units.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>

#include "apps/io/tables/fields.hpp"

namespace powercell::io {
namespace {

using Unit = ColumnHeading::Unit;

struct Spelling {
  std::string_view text, unit;
  bool bare = true;  ///< whether it is a unit without brackets too: "r_in" may be an inner radius
};

constexpr Spelling lengths[] = {{"m", "m"},
                                {"metre", "m"},
                                {"metres", "m"},
                                {"meter", "m"},
                                {"meters", "m"},
                                {"dm", "dm"},
                                {"cm", "cm"},
                                {"centimetre", "cm"},
                                {"centimetres", "cm"},
                                {"centimeter", "cm"},
                                {"centimeters", "cm"},
                                {"mm", "mm"},
                                {"millimetre", "mm"},
                                {"millimetres", "mm"},
                                {"millimeter", "mm"},
                                {"millimeters", "mm"},
                                {"um", "um"},
                                {"micron", "um"},
                                {"microns", "um"},
                                {"micrometre", "um"},
                                {"micrometres", "um"},
                                {"micrometer", "um"},
                                {"micrometers", "um"},
                                {"nm", "nm"},
                                {"nanometre", "nm"},
                                {"nanometres", "nm"},
                                {"nanometer", "nm"},
                                {"nanometers", "nm"},
                                {"km", "km"},
                                {"kilometre", "km"},
                                {"kilometres", "km"},
                                {"kilometer", "km"},
                                {"kilometers", "km"},
                                {"a", "angstrom", false},
                                {"ang", "angstrom"},
                                {"angstrom", "angstrom"},
                                {"angstroms", "angstrom"},
                                {"ft", "ft"},
                                {"foot", "ft"},
                                {"feet", "ft"},
                                {"in", "inch", false},
                                {"inch", "inch"},
                                {"inches", "inch"},
                                {"yd", "yd"},
                                {"yard", "yd"},
                                {"yards", "yd"},
                                {"mi", "mile", false},
                                {"mile", "mile"},
                                {"miles", "mile"},
                                {"px", "pixel"},
                                {"pix", "pixel"},
                                {"pixel", "pixel"},
                                {"pixels", "pixel"},
                                {"voxel", "voxel"},
                                {"voxels", "voxel"},
                                {"pc", "pc", false},
                                {"kpc", "kpc"},
                                {"mpc", "mpc", false},
                                {"au", "au", false}};

constexpr std::string_view degrees[] = {"deg",  "degree", "degrees",     "dd",          "decimaldegrees",
                                        "dege", "degn",   "degreeseast", "degreesnorth"};
constexpr std::string_view squares_before[] = {"sq.", "sq", "square"};
constexpr std::string_view squares_after[] = {"**2", "^2", "2", "squared"};
constexpr std::string_view marks = " \t_-/,.:";

/// With letters and powers that other encodings spell by several bytes in ASCII: micro, angstrom, squared.
std::string in_ascii(std::string name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> spellings = {
      {{"\xC2\xB5", "u"},
       {"\xCE\xBC", "u"},
       {"\xCE\x9C", "u"},
       {"\xC3\x85", "angstrom"},
       {"\xC3\xA5", "angstrom"},
       {"\xE2\x84\xAB", "angstrom"},
       {"\xC2\xB2", "2"},
       {"\xC2\xB0", "deg"}}};
  for (const auto& [from, to] : spellings)
    for (std::size_t at = 0; (at = name.find(from, at)) != std::string::npos; at += to.size())
      name.replace(at, from.size(), to);
  for (std::size_t at = 0; at < name.size(); ++at) {  // Latin-1
    const bool alone = at == 0 || static_cast<unsigned char>(name[at - 1]) < 0x80;
    if (alone && name[at] == '\xB5') name[at] = 'u';
    if (alone && name[at] == '\xB2') name[at] = '2';
  }
  return name;
}

void strip_end(std::string& name) {
  while (!name.empty() && marks.find(name.back()) != std::string_view::npos) name.pop_back();
}

std::optional<std::string_view> length_of(std::string_view text, bool bare) {
  for (const Spelling& spelling : lengths)
    if (spelling.text == text && (spelling.bare || !bare)) return spelling.unit;
  return std::nullopt;
}

/// The kind and the spelling of a unit; none if it is not known.
/// \param bare  without brackets
std::pair<Unit, std::string> known_unit(std::string_view text, bool bare) {
  std::string packed;
  for (const char c : text)
    if (c != ' ' && c != '_') packed += c;
  if (std::find(std::begin(degrees), std::end(degrees), packed) != std::end(degrees))
    return {Unit::degree, "deg"};
  if (const auto length = length_of(packed, bare)) return {Unit::length, std::string(*length)};
  const std::string_view rest = packed;
  for (const std::string_view square : squares_before)
    if (rest.starts_with(square))
      if (const auto length = length_of(rest.substr(square.size()), bare))
        return {Unit::area, std::string(*length)};
  for (const std::string_view square : squares_after)
    if (rest.ends_with(square))
      if (const auto length = length_of(rest.substr(0, rest.size() - square.size()), bare))
        return {Unit::area, std::string(*length)};
  return {Unit::none, ""};
}

bool take_brackets(ColumnHeading& heading) {
  std::string& name = heading.name;
  constexpr std::string_view open = "([{<", close = ")]}>";
  const std::size_t kind = name.empty() ? std::string_view::npos : close.find(name.back());
  if (kind == std::string_view::npos) return false;
  const std::size_t at = name.find(open[kind]);
  if (at == std::string::npos || at == 0) return false;
  const std::string text = column_name(std::string_view(name).substr(at + 1, name.size() - at - 2));
  std::string before = name.substr(0, at);
  strip_end(before);
  if (before.empty()) return false;
  std::tie(heading.kind, heading.unit) = known_unit(text, false);
  if (heading.is(Unit::none)) heading.kind = Unit::other, heading.unit = text;
  name = std::move(before);
  return true;
}

void take_last_words(ColumnHeading& heading) {
  std::string& name = heading.name;
  std::size_t at = name.size();
  for (int words = 1; words <= 2; ++words) {  // "sq mm" has two
    at = at == 0 ? std::string::npos : name.find_last_of(marks, at - 1);
    if (at == std::string::npos || at == 0) return;
    const auto [kind, unit] = known_unit(std::string_view(name).substr(at + 1), true);
    if (kind == Unit::none || (words == 2 && kind != Unit::area)) continue;
    std::string before = name.substr(0, at);
    strip_end(before);
    if (before.ends_with(" in") || before.ends_with("_in")) before.resize(before.size() - 3);
    // "w sq mm" is found by its last word first.
    for (const std::string_view square : {"sq", "square"})
      if (kind == Unit::length && before.size() > square.size() && before.ends_with(square) &&
          marks.find(before[before.size() - square.size() - 1]) != std::string_view::npos) {
        before.resize(before.size() - square.size() - 1);
        heading.kind = Unit::area;
      }
    if (!heading.is(Unit::area)) heading.kind = kind;
    heading.unit = unit;
    name = std::move(before);
    return;
  }
}

}  // namespace

ColumnHeading column_heading(std::string_view field) {
  ColumnHeading heading;
  heading.name = in_ascii(column_name(field));
  if (!take_brackets(heading)) take_last_words(heading);
  return heading;
}

}  // namespace powercell::io
