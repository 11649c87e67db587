/// \file
/// Colours that stand for numbers and for classes.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/io/picture/palette.hpp"

namespace powercell::io {

/// Of cells without a value, and of the stripes that mark them in flat pictures.
constexpr Colour no_value{0xdc, 0xdc, 0xdc}, no_value_stripe{0xa6, 0xa6, 0xa6};

/// The colour of `t` in [0, 1], from deep blue through green to yellow. Lightness grows all along, and equal
/// steps look about equally large, also with the common colour vision deficiencies.
Colour scale_colour(double t);

/// Distinct colours, as far apart as so many can be, also with the common colour vision deficiencies. The
/// first ones are the same for any count.
std::vector<Colour> class_colours(std::size_t count);

/// More classes are not told apart.
constexpr std::size_t most_classes = 40;

}  // namespace powercell::io
