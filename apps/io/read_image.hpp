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

/// The luminance, in linear light, of a PNG of any kind with 8 or 16 bits; transparent parts show white
/// paper. \throw Error invalid_file (not a PNG, damaged, or more than 2^28 pixels)
GrayImage read_image(const std::string& path);
/// The same from memory.
GrayImage parse_png(std::string_view bytes, const std::string& name);

}  // namespace powercell::io
