// Curves of SVG outlines: transforms, arcs as cubics, cubics as polylines.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/io/read/svg_path.hpp"

namespace powercell::io {

SvgTransform SvgTransform::operator*(const SvgTransform& inner) const {
  return {a * inner.a + c * inner.b, b * inner.a + d * inner.b,     a * inner.c + c * inner.d,
          b * inner.c + d * inner.d, a * inner.e + c * inner.f + e, b * inner.e + d * inner.f + f};
}

void SvgOutline::line_to(const SvgPoint& p) {
  pieces.push_back({last(), p, p, true});
}

void SvgOutline::curve_to(const SvgPoint& control1, const SvgPoint& control2, const SvgPoint& p) {
  pieces.push_back({control1, control2, p, false});
}

void transform(SvgOutline& outline, const SvgTransform& by) {
  outline.start = by(outline.start);
  for (SvgOutline::Piece& piece : outline.pieces) {
    piece = {by(piece.control1), by(piece.control2), by(piece.end), piece.straight};
  }
}

void add_svg_arc(SvgOutline& outline, double rx, double ry, double rotation, bool large, bool sweep,
                 const SvgPoint& end) {
  const SvgPoint start = outline.last();
  rx = std::abs(rx);
  ry = std::abs(ry);
  if (start == end) return;
  if (rx == 0 || ry == 0) return outline.line_to(end);
  const double phi = rotation * std::numbers::pi / 180, cos_phi = std::cos(phi), sin_phi = std::sin(phi);
  // Half of the chord and the centre, in the frame of the ellipse scaled to the unit circle.
  const double hx = (start[0] - end[0]) / 2, hy = (start[1] - end[1]) / 2;
  double ux = (cos_phi * hx + sin_phi * hy) / rx, uy = (-sin_phi * hx + cos_phi * hy) / ry;
  const double half = std::hypot(ux, uy);
  if (half > 1) {  // radii too small to reach: scaled up until they do
    rx *= half;
    ry *= half;
    ux /= half;
    uy /= half;
  }
  const double square = ux * ux + uy * uy;
  const double away =
      square > 0 ? std::sqrt(std::max(0.0, 1 - square) / square) * (large == sweep ? -1 : 1) : 0;
  const double cx = away * uy, cy = -away * ux;
  const double from = std::atan2(uy - cy, ux - cx);
  double sweep_angle = std::atan2(-uy - cy, -ux - cx) - from;
  if (sweep && sweep_angle < 0) sweep_angle += 2 * std::numbers::pi;
  if (!sweep && sweep_angle > 0) sweep_angle -= 2 * std::numbers::pi;

  const auto place = [&](double x, double y) {
    const double px = rx * (x + cx), py = ry * (y + cy);
    return SvgPoint{cos_phi * px - sin_phi * py + (start[0] + end[0]) / 2,
                    sin_phi * px + cos_phi * py + (start[1] + end[1]) / 2};
  };
  // An eighth of a turn as a cubic is off by 4e-6 of the radius: below svg_tolerance.
  // Radii beyond the range of doubles give no angle; the reader refuses the coordinates, which are not
  // finite.
  const double turns = std::isfinite(sweep_angle) ? std::abs(sweep_angle) / (std::numbers::pi / 4) : 0;
  const int pieces = std::max(1, static_cast<int>(std::ceil(turns - 1e-9)));
  const double step = sweep_angle / pieces, reach = 4.0 / 3 * std::tan(step / 4);
  for (int k = 0; k < pieces; ++k) {
    const double t = from + k * step, u = t + step;
    outline.curve_to(place(std::cos(t) - reach * std::sin(t), std::sin(t) + reach * std::cos(t)),
                     place(std::cos(u) + reach * std::sin(u), std::sin(u) - reach * std::cos(u)),
                     k + 1 == pieces ? end : place(std::cos(u), std::sin(u)));
  }
}

Ring flatten(const SvgOutline& outline, double tolerance) {
  constexpr double most_steps = 4096;
  Ring ring{outline.start};
  SvgPoint from = outline.start;
  for (const SvgOutline::Piece& piece : outline.pieces) {
    int steps = 1;
    if (!piece.straight) {
      // The chord of a step h is off by at most h^2/8 max|B''|, and |B''| <= 6 max of the second differences.
      const auto second = [](const SvgPoint& p, const SvgPoint& q, const SvgPoint& r) {
        return std::hypot(p[0] - 2 * q[0] + r[0], p[1] - 2 * q[1] + r[1]);
      };
      const double bend = std::max(second(from, piece.control1, piece.control2),
                                   second(piece.control1, piece.control2, piece.end));
      steps = tolerance > 0 ? static_cast<int>(std::clamp(std::ceil(std::sqrt(6 * bend / (8 * tolerance))),
                                                          1.0, most_steps))
                            : 1;
    }
    for (int k = 1; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps, o = 1 - t;
      const double b0 = o * o * o, b1 = 3 * o * o * t, b2 = 3 * o * t * t, b3 = t * t * t;
      ring.push_back({b0 * from[0] + b1 * piece.control1[0] + b2 * piece.control2[0] + b3 * piece.end[0],
                      b0 * from[1] + b1 * piece.control1[1] + b2 * piece.control2[1] + b3 * piece.end[1]});
    }
    ring.push_back(piece.end);
    from = piece.end;
  }
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

}  // namespace powercell::io
