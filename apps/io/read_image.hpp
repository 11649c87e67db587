/// \file
/// Images as arrays.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

/// Luminance of pixels, 0 (black) to 1 (white), rows from the top.
struct GrayImage {
  std::size_t width = 0, height = 0;
  std::vector<double> values;
};

/// The luminance, in linear light, of a PNG or JPEG of any kind, turned as its Exif orientation says.
/// Transparent parts show white paper. Channels are sRGB unless a PNG's cICP or gAMA says otherwise; ICC
/// profiles are not applied. \throw Error invalid_file (not a PNG or JPEG, damaged, or more than 2^28 pixels)
GrayImage read_image(const std::string& path);
/// The same from memory.
GrayImage parse_image(std::string_view bytes, const std::string& name);

}  // namespace powercell::io
