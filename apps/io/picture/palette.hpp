/// \file
/// Colours of cells.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/results.hpp>
#include <string>
#include <vector>

namespace powercell::io {

/// sRGB, 8 bits a channel.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// Linear light, from 0 to 1, of a channel (IEC 61966-2-1), and the channel of it.
double to_linear(std::uint8_t channel);
double to_linear(double channel);  ///< of a channel from 0 to 1
std::uint8_t to_srgb(double linear);

/// "#rrggbb".
std::string hex(Colour colour);
/// Moves each channel towards `other` by `share` in [0, 1].
Colour mix(Colour colour, Colour other, double share);

constexpr Colour ink{0x1d, 0x2b, 0x3a};         ///< outlines and seeds
constexpr Colour dark_paper{0x10, 0x10, 0x12};  ///< of dots that stand for light
constexpr Colour paper{0xff, 0xff, 0xff};       ///< background and walls of 2D pictures

/// Muted hues that also differ in lightness, from deep blue through sand to brick.
constexpr Colour deep_blue{0x3a, 0x6b, 0x9c}, sky{0x7f, 0xb2, 0xd9}, teal{0x3c, 0x95, 0x94},
    sand{0xf3, 0xd2, 0x7f}, amber{0xee, 0x9b, 0x52}, brick{0xd3, 0x5f, 0x4b}, mint{0xa8, 0xd5, 0xc2},
    shell{0xf4, 0xe6, 0xd0};

/// One colour for each cell. Hues come from a small palette that remains distinct under the common colour
/// vision deficiencies. They are chosen greedily so that cells with a common wall differ; a cell with
/// neighbours of every hue (in space) gets the hue with which it shares the least wall. Lightness varies a
/// little from seed to seed. The same diagram has the same colours every time.
std::vector<Colour> cell_colours(const Adjacency& adjacency, std::size_t cells);

}  // namespace powercell::io
