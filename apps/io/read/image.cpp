#include "apps/io/read/image.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/image_parts.hpp"

namespace powercell::io {

void check_size(const AnnouncedImage& image, const std::string& name) {
  constexpr std::uint64_t most_pixels = std::uint64_t{1} << 28;
  const std::uint64_t pixels = image.width * image.height;
  const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels";
  if (pixels > most_pixels) fail_file(name, size + " are too many");
  if (pixels > image.most_pixels_a_byte * image.bytes)
    fail_file(name, std::string("damaged ") + image.format + ": " + std::to_string(image.bytes) +
                        " bytes cannot hold " + size);
}

GrayImage parse_image(std::string_view bytes, const std::string& name, bool colours) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return parse_png(bytes, name, colours);
  if (bytes.starts_with("\xff\xd8\xff")) return parse_jpeg(bytes, name, colours);
  fail_file(name,
            fmt::format("not a PNG or JPEG picture; convert it, for instance with 'convert {} converted.png'",
                        printable(std::filesystem::path(name).filename().string())));
}

GrayImage read_image(const std::string& path, bool colours) {
  return parse_image(read_file(path), path, colours);
}

}  // namespace powercell::io
