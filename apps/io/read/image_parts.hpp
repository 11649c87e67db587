/// \file
/// What the readers of image formats share. Internal.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "apps/io/read/image.hpp"

namespace powercell::io {

GrayImage parse_png(std::string_view bytes, const std::string& name, bool colours);
GrayImage parse_jpeg(std::string_view bytes, const std::string& name, bool colours);

/// The size that an image's header announces, before memory is allocated for it.
struct AnnouncedImage {
  const char* format;  ///< "PNG"
  std::uint64_t width, height;
  std::uint64_t bytes;               ///< of the file
  std::uint64_t most_pixels_a_byte;  ///< that the format can pack into a byte
};
/// \throw Error invalid_file for more than 2^28 pixels, or more than the bytes can hold
void check_size(const AnnouncedImage& image, const std::string& name);

/// Luminance of linear red, green and blue with the primaries of sRGB.
constexpr double luminance(double red, double green, double blue) {
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

/// The orientation, 1 to 8, in the Exif data of an image; 1 if it has none.
/// \param tiff  Exif data from its byte order ("II" or "MM") on
int exif_orientation(std::string_view tiff);

/// Mirrors and turns the pixels as they were stored to the image as it is meant to be seen.
/// \param orientation  of exif_orientation
GrayImage upright(GrayImage stored, int orientation);

}  // namespace powercell::io
