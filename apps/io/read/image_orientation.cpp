#include "apps/io/read/image_parts.hpp"

namespace powercell::io {
namespace {

/// Numbers in the byte order of a TIFF file.
class TiffNumbers {
 public:
  explicit TiffNumbers(std::string_view bytes) : bytes_(bytes), little_(bytes.starts_with("II")) {}

  bool holds(std::size_t at, std::size_t count) const {
    return at <= bytes_.size() && count <= bytes_.size() - at;
  }
  /// The number of `count` bytes at `at`, which must be in the file.
  std::size_t number(std::size_t at, std::size_t count) const {
    std::size_t value = 0;
    for (std::size_t k = 0; k < count; ++k)
      value = value << 8 | static_cast<unsigned char>(bytes_[at + (little_ ? count - 1 - k : k)]);
    return value;
  }

 private:
  std::string_view bytes_;
  bool little_;
};

}  // namespace

int exif_orientation(std::string_view tiff) {
  constexpr std::size_t entry_size = 12, orientation_tag = 0x0112, short_type = 3;
  const TiffNumbers file(tiff);
  if (!file.holds(0, 8) || (!tiff.starts_with("II") && !tiff.starts_with("MM"))) return 1;
  const std::size_t directory = file.number(4, 4);
  if (!file.holds(directory, 2)) return 1;
  const std::size_t entries = file.number(directory, 2);
  for (std::size_t k = 0; k < entries; ++k) {
    const std::size_t entry = directory + 2 + k * entry_size;
    if (!file.holds(entry, entry_size)) return 1;
    if (file.number(entry, 2) != orientation_tag || file.number(entry + 2, 2) != short_type) continue;
    const std::size_t value = file.number(entry + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

namespace {

/// The pixels of one channel, mirrored and turned.
template <class Number>
std::vector<Number> turned_pixels(const std::vector<Number>& stored, std::size_t w, std::size_t h,
                                  int orientation) {
  const bool transposed = orientation >= 5;
  // Of the stored image, after the transposition.
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  const std::size_t width = transposed ? h : w, height = transposed ? w : h;
  std::vector<Number> result(stored.size());
  for (std::size_t y = 0; !stored.empty() && y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t column = transposed ? y : x, row = transposed ? x : y;
      result[y * width + x] =
          stored[(from_bottom ? h - 1 - row : row) * w + (from_right ? w - 1 - column : column)];
    }
  return result;
}

}  // namespace

GrayImage upright(GrayImage stored, int orientation) {
  if (orientation == 1) return stored;
  const std::size_t w = stored.width, h = stored.height;
  const bool transposed = orientation >= 5;
  GrayImage result{
      transposed ? h : w, transposed ? w : h, turned_pixels(stored.values, w, h, orientation), {}};
  for (std::size_t c = 0; c < 3; ++c)
    result.channels[c] = turned_pixels(stored.channels[c], w, h, orientation);
  return result;
}

}  // namespace powercell::io
