#include "apps/io/read_image.hpp"

#include <png.h>

#include <cstdint>
#include <memory>

#include "apps/io/read_file.hpp"

namespace powercell::io {
namespace {

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 28;

struct Freed {
  void operator()(png_image* image) const { png_image_free(image); }
};

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
  image.format = PNG_FORMAT_LINEAR_Y_ALPHA;
  const std::size_t count = std::size_t{image.width} * image.height;
  std::vector<std::uint16_t> pixels(2 * count);
  // A row's length is given in 16-bit numbers; 0 means rows without gaps.
  if (!png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr))
    fail_file(name, "damaged PNG: " + readable(image.message));
  GrayImage result{image.width, image.height, std::vector<double>(count)};
  // The luminance is multiplied with the opacity; the rest of the light is the paper's.
  for (std::size_t k = 0; k < count; ++k)
    result.values[k] = (pixels[2 * k] + (65535.0 - pixels[2 * k + 1])) / 65535.0;
  return result;
}

GrayImage read_image(const std::string& path) {
  return parse_png(read_file(path), path);
}

}  // namespace powercell::io
