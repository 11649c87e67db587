/// \file
/// Pictures as numbers.
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

/// A PNG of any kind, 8 or 16 bits: its luminance in linear light; transparent parts are on white paper.
/// \throw Error invalid_file (no PNG, damaged, or of more than 2^28 pixels)
GrayImage read_image(const std::string& path);
/// The same from memory.
GrayImage parse_png(std::string_view bytes, const std::string& name);

}  // namespace powercell::io
