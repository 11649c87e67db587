#include "apps/io/picture/colour_spaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace powercell::io {
namespace {

using LinearRgb = std::array<double, 3>;  // linear red, green and blue

using SightMatrix = std::array<LinearRgb, 3>;
constexpr std::array<SightMatrix, 3> dichromats = {{
    {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
    {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
    {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}},
}};

LinearRgb light_of(Colour colour) {
  return {to_linear(colour.red), to_linear(colour.green), to_linear(colour.blue)};
}

LinearRgb light_of(const Lab& lab) {
  const double l = std::pow(lab.lightness + 0.3963377774 * lab.a + 0.2158037573 * lab.b, 3);
  const double m = std::pow(lab.lightness - 0.1055613458 * lab.a - 0.0638541728 * lab.b, 3);
  const double s = std::pow(lab.lightness - 0.0894841775 * lab.a - 1.2914855480 * lab.b, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

Lab lab_of(const LinearRgb& light) {
  const auto& [red, green, blue] = light;
  const double l = std::cbrt(0.4122214708 * red + 0.5363325363 * green + 0.0514459929 * blue);
  const double m = std::cbrt(0.2119034982 * red + 0.6806995451 * green + 0.1073969566 * blue);
  const double s = std::cbrt(0.0883024619 * red + 0.2817188376 * green + 0.6299787005 * blue);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

}  // namespace

Lab to_lab(const Lch& lch) {
  const double angle = 2 * std::numbers::pi * lch.hue;
  return {lch.lightness, lch.chroma * std::cos(angle), lch.chroma * std::sin(angle)};
}

Lab to_lab(Colour colour) {
  return lab_of(light_of(colour));
}

Colour to_colour(const Lab& lab) {
  const LinearRgb light = light_of(lab);
  return {to_srgb(light[0]), to_srgb(light[1]), to_srgb(light[2])};
}

Colour to_colour(const Lch& lch) {
  return to_colour(to_lab(lch));
}

bool is_in_srgb(const Lab& lab) {
  const LinearRgb light = light_of(lab);
  return std::all_of(light.begin(), light.end(), [](double c) { return c >= 0 && c <= 1; });
}

double distance(const Lab& a, const Lab& b) {
  return std::hypot(a.lightness - b.lightness, a.a - b.a, a.b - b.b);
}

std::array<Lab, 4> as_seen(Colour colour) {
  const LinearRgb light = light_of(colour);
  std::array<Lab, 4> seen{lab_of(light)};
  for (std::size_t k = 0; k < dichromats.size(); ++k) {
    LinearRgb other{};
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column)
        other[row] += dichromats[k][row][column] * light[column];
      other[row] = std::clamp(other[row], 0.0, 1.0);
    }
    seen[k + 1] = lab_of(other);
  }
  return seen;
}

}  // namespace powercell::io
