/// \file
/// Outlines of SVG elements as straight lines and cubic curves.
#pragma once

#include <array>
#include <powercell/domain.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

using SvgPoint = std::array<double, 2>;

/// x' = a x + c y + e, y' = b x + d y + f, in SVG's order a b c d e f.
struct SvgTransform {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  SvgPoint operator()(const SvgPoint& p) const { return {a * p[0] + c * p[1] + e, b * p[0] + d * p[1] + f}; }
  SvgTransform operator*(const SvgTransform& inner) const;  ///< `inner` first
};

/// A closed outline: it starts at `start`; each piece is a cubic curve (two control points, end); a
/// straight line has both control points at its ends and `straight` set.
struct SvgOutline {
  struct Piece {
    SvgPoint control1, control2, end;
    bool straight;
  };
  SvgPoint start;
  std::vector<Piece> pieces;

  void line_to(const SvgPoint& p);
  void curve_to(const SvgPoint& control1, const SvgPoint& control2, const SvgPoint& p);
  const SvgPoint& last() const { return pieces.empty() ? start : pieces.back().end; }
};

/// A fault of an attribute; the caller adds file and line.
struct SvgError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The outlines of the attribute `d` of a path.
/// \throw SvgError
std::vector<SvgOutline> parse_svg_path(std::string_view d);

/// An arc of an ellipse appended to `outline`, by the rules of SVG 1.1 appendix F.6.
/// \param rotation of the ellipse's x axis, in degrees
void add_svg_arc(SvgOutline& outline, double rx, double ry, double rotation, bool large, bool sweep,
                 const SvgPoint& end);

/// The value of an attribute `transform`.
/// \throw SvgError
SvgTransform parse_svg_transform(std::string_view text);

/// All numbers of a list separated by blanks and commas.
/// \throw SvgError
std::vector<double> parse_svg_numbers(std::string_view text);

void transform(SvgOutline& outline, const SvgTransform& by);

/// The outline as a ring whose distance from the curve is at most `tolerance`.
Ring flatten(const SvgOutline& outline, double tolerance);

}  // namespace powercell::io
