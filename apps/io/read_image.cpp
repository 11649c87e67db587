#include "apps/io/read_image.hpp"

#include <png.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "apps/io/picture_palette.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read_file.hpp"

namespace powercell::io {
namespace {

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 28;
/// Deflate expands a byte to at most 1032 bytes, each with eight pixels of one bit.
constexpr std::uint64_t most_pixels_a_byte = 8 * 1032;

struct Freed {
  void operator()(png_image* image) const { png_image_free(image); }
};

/// \param image  after begin_read   \return pixels of `channels` values each
template <class T>
std::vector<T> read_pixels(png_image& image, png_uint_32 format, std::size_t channels,
                           const std::string& name) {
  image.format = format;
  std::vector<T> pixels(channels * image.width * image.height);
  // The row length is in values; 0 means rows without padding.
  if (!png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr))
    fail_file(name, "damaged PNG: " + readable(image.message));
  return pixels;
}

/// For files of 16 bits libpng gives the luminance multiplied by the opacity. The paper adds the rest of the
/// light.
void read_deep(png_image& image, const std::string& name, std::vector<double>& values) {
  const auto pixels = read_pixels<std::uint16_t>(image, PNG_FORMAT_LINEAR_Y_ALPHA, 2, name);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = (pixels[2 * k] + (65535.0 - pixels[2 * k + 1])) / 65535.0;
}

/// For files of at most 8 bits libpng would also round the luminance to 8 bits.
void read_shallow(png_image& image, const std::string& name, std::vector<double>& values) {
  const auto pixels = read_pixels<std::uint8_t>(image, PNG_FORMAT_RGBA, 4, name);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::uint8_t* const p = &pixels[4 * k];
    const double luminance = 0.2126 * to_linear(p[0]) + 0.7152 * to_linear(p[1]) + 0.0722 * to_linear(p[2]);
    values[k] = 1 - p[3] / 255.0 * (1 - luminance);
  }
}

}  // namespace

GrayImage parse_png(std::string_view bytes, const std::string& name) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, Freed> owner(&image);
  if (bytes.size() < 8 || png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) != 0)
    fail_file(name, "not a PNG picture; convert it, for instance with 'convert photo.jpg photo.png'");
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()))
    fail_file(name, "damaged PNG: " + readable(image.message));
  if (std::uint64_t{image.width} * image.height > most_pixels)
    fail_file(name,
              std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels are too many");
  if (std::uint64_t{image.width} * image.height > most_pixels_a_byte * bytes.size())
    fail_file(name, "damaged PNG: " + std::to_string(bytes.size()) + " bytes cannot hold " +
                        std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels");
  GrayImage result{image.width, image.height, std::vector<double>(std::size_t{image.width} * image.height)};
  if (image.format & PNG_FORMAT_FLAG_LINEAR)
    read_deep(image, name, result.values);
  else
    read_shallow(image, name, result.values);
  return result;
}

GrayImage read_image(const std::string& path) {
  return parse_png(read_file(path), path);
}

}  // namespace powercell::io
