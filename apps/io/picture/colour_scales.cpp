#include "apps/io/picture/colour_scales.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "apps/io/picture/colour_spaces.hpp"

namespace powercell::io {
namespace {

// A curve in OKLab with these control points; its hue runs from blue to yellow without red, which some do not
// tell from green.
const std::array<Lab, 3>& control_points() {
  static const std::array<Lab, 3> points = {to_lab(Lch{0.36, 0.11, 275.0 / 360}),
                                            to_lab(Lch{0.60, 0.16, 200.0 / 360}),
                                            to_lab(Lch{0.93, 0.16, 103.0 / 360})};
  return points;
}

Lab on_curve(double s) {
  const auto& [p, q, r] = control_points();
  const double a = (1 - s) * (1 - s), b = 2 * s * (1 - s), c = s * s;
  return {a * p.lightness + b * q.lightness + c * r.lightness, a * p.a + b * q.a + c * r.a,
          a * p.b + b * q.b + c * r.b};
}

// The curve at equal steps of its length.
constexpr std::size_t scale_steps = 256;
std::vector<Colour> even_steps() {
  constexpr std::size_t fine = 4096;
  std::vector<double> length = {0};
  for (std::size_t k = 1; k <= fine; ++k)
    length.push_back(length.back() + distance(on_curve(static_cast<double>(k - 1) / fine),
                                              on_curve(static_cast<double>(k) / fine)));
  std::vector<Colour> colours;
  std::size_t k = 0;
  for (std::size_t step = 0; step < scale_steps; ++step) {
    const double wanted = length.back() * static_cast<double>(step) / (scale_steps - 1);
    while (k < fine && length[k + 1] < wanted) ++k;
    const double rest = (wanted - length[k]) / (length[k + 1] - length[k]);
    colours.push_back(to_colour(on_curve((static_cast<double>(k) + rest) / fine)));
  }
  return colours;
}

// Of the palette of cells, without those near to white.
constexpr std::array<Colour, 7> first_classes = {deep_blue, amber, mint, brick, sand, teal, sky};

using Seen = std::array<Lab, 4>;

// The least of the distances with each kind of sight.
double apart(const Seen& a, const Seen& b) {
  constexpr Seen::size_type kinds = std::tuple_size_v<Seen>;
  constexpr std::array<double, kinds> importance = {0.8, 1, 1, 1.3};  // blindness to blue is rare
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < kinds; ++k) least = std::min(least, importance[k] * distance(a[k], b[k]));
  return least;
}

struct Candidate {
  Colour colour;
  Seen seen;
  double nearest;  // distance to the colours that are taken
};

std::vector<Candidate> candidates() {
  std::vector<Candidate> all;
  for (const double lightness : {0.42, 0.50, 0.58, 0.66, 0.74, 0.82, 0.90})
    for (const double chroma : {0.04, 0.09, 0.14})
      for (int k = 0; k < 24; ++k) {
        const Lab lab = to_lab(Lch{lightness, chroma, k / 24.0});
        if (!is_in_srgb(lab)) continue;
        const Colour colour = to_colour(lab);
        all.push_back({colour, as_seen(colour), std::numeric_limits<double>::infinity()});
      }
  return all;
}

void take(std::vector<Candidate>& from, Colour colour) {
  const Seen seen = as_seen(colour);
  for (Candidate& candidate : from)
    candidate.nearest = std::min(candidate.nearest, apart(candidate.seen, seen));
}

}  // namespace

Colour scale_colour(double t) {
  static const std::vector<Colour> colours = even_steps();
  return colours[static_cast<std::size_t>(std::lround(std::clamp(t, 0.0, 1.0) * (scale_steps - 1)))];
}

// The farthest candidate each time (Gonzalez 1985).
std::vector<Colour> class_colours(std::size_t count) {
  std::vector<Colour> colours(
      first_classes.begin(),
      first_classes.begin() + static_cast<std::ptrdiff_t>(std::min(count, first_classes.size())));
  if (count <= colours.size()) return colours;
  std::vector<Candidate> from = candidates();
  for (const Colour colour : {paper, no_value}) take(from, colour);
  for (const Colour colour : colours) take(from, colour);
  while (colours.size() < count) {
    const auto farthest =
        std::max_element(from.begin(), from.end(),
                         [](const Candidate& a, const Candidate& b) { return a.nearest < b.nearest; });
    colours.push_back(farthest->colour);
    take(from, colours.back());
  }
  return colours;
}

}  // namespace powercell::io
