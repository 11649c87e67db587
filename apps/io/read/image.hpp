/// \file
/// Images as arrays.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

/// Luminance of pixels, 0 (black) to 1 (white), rows from the top.
struct GrayImage {
  std::size_t width = 0, height = 0;
  std::vector<double> values;
  /// Linear red, green and blue, 0 to 1, of the same pixels; empty unless they were asked for.
  std::array<std::vector<float>, 3> channels;
};

/// The luminance, in linear light, of a PNG or JPEG of any kind, turned as its Exif orientation says.
/// Transparent parts show white paper. Channels are sRGB unless a PNG's cICP or gAMA says otherwise; ICC
/// profiles are not applied.
/// \param colours  whether the channels are wanted too
/// \throw Error invalid_file (not a PNG or JPEG, damaged, or more than 2^28 pixels)
GrayImage read_image(const std::string& path, bool colours = false);
/// The same from memory.
GrayImage parse_image(std::string_view bytes, const std::string& name, bool colours = false);

}  // namespace powercell::io
