/// \file
/// Names of columns: those of positions, and units as in: "radius (mm)", "x[m]", "weight_mm2".
#pragma once

#include <string>
#include <string_view>

namespace powercell::io {

/// The columns of positions.
inline constexpr std::string_view axis_names[] = {"x", "y", "z"};

/// The name of a column in lower case, without its unit.
struct ColumnHeading {
  enum class Unit {
    none,
    length,  ///< `unit` is one of the known lengths, in one spelling: "mm" for millimetres too
    area,    ///< the square of one; `unit` is that length
    degree,
    other,  ///< in brackets, and none of these
  };
  std::string name;
  Unit kind = Unit::none;
  std::string unit;

  bool is(Unit wanted) const { return kind == wanted; }
};

/// A unit is the text in brackets at the end, or a known length, area or "deg" as the last word, after a
/// blank or a mark: r_m, "x mm", "w/cm^2". A name that is nothing but a unit has none.
ColumnHeading column_heading(std::string_view field);

}  // namespace powercell::io
