/// \file
/// Colours as people see them.
#pragma once

#include <array>

#include "apps/io/picture/palette.hpp"

namespace powercell::io {

/// Ottosson's OKLab (2020), in which equal distances look about equally different.
struct Lab {
  double lightness = 0, a = 0, b = 0;
};
/// The same in polar coordinates; the hue in turns.
struct Lch {
  double lightness = 0, chroma = 0, hue = 0;
};

Lab to_lab(const Lch& lch);
Lab to_lab(Colour colour);
/// Channels beyond those of sRGB are clamped.
Colour to_colour(const Lab& lab);
Colour to_colour(const Lch& lch);
bool is_in_srgb(const Lab& lab);

double distance(const Lab& a, const Lab& b);

/// As people with normal sight see a colour, and those without the cones for long, middle and short waves
/// (Machado, Oliveira and Fernandes 2009).
std::array<Lab, 4> as_seen(Colour colour);

}  // namespace powercell::io
