#include <png.h>

#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <vector>

#include "apps/io/picture/palette.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/image_parts.hpp"

namespace powercell::io {
namespace {

/// libpng on bytes in memory. Its errors come by longjmp, past the frames of the functions below that call
/// it: those frames hold no objects with destructors.
class PngFile {
 public:
  PngFile(std::string_view bytes, const std::string& name)
      : name_(name),
        rest_(bytes),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning)) {
    if (png_) info_ = png_create_info_struct(png_);
    if (info_) return;
    png_destroy_read_struct(&png_, nullptr, nullptr);
    throw std::bad_alloc();
  }
  ~PngFile() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  void read_header() { require(try_header()); }
  std::size_t width() const { return png_get_image_width(png_, info_); }
  std::size_t height() const { return png_get_image_height(png_, info_); }

  /// Red, green, blue and opacity of each pixel in 16 bits, coded as in the file.
  std::vector<std::uint16_t> pixels() {
    std::vector<std::uint16_t> values(4 * width() * height());
    std::vector<png_bytep> rows(height());
    for (std::size_t y = 0; y < rows.size(); ++y)
      rows[y] = reinterpret_cast<png_bytep>(&values[4 * width() * y]);
    require(try_rows(rows.data()));
    return values;
  }

  /// The linear light, from 0 to 1, of a coded channel from 0 to 1. Of the chunks about colours the first in
  /// this order counts: cICP, sRGB, gAMA. Without them the file is sRGB, as viewers have it.
  double light(double channel) const {
    if (gamma_ == 0) return to_linear(channel);
    return std::pow(channel, 1 / gamma_);
  }

  /// To be called after the rows are read: the chunk may come after them.
  int orientation() const {
    png_uint_32 size = 0;
    png_bytep data = nullptr;
    if (!png_get_eXIf_1(png_, info_, &size, &data)) return 1;
    return exif_orientation({reinterpret_cast<const char*>(data), size});
  }

  void find_coding() {
    png_unknown_chunkp chunks = nullptr;
    const int count = png_get_unknown_chunks(png_, info_, &chunks);
    for (int k = 0; k < count; ++k)
      if (std::memcmp(chunks[k].name, "cICP", 4) == 0 && chunks[k].size == 4)
        return find_cicp(chunks[k].data[1]);
    // libpng sets gAMA too where it finds sRGB. 1/2.2 is what files of sRGB carry for old readers.
    png_fixed_point gamma = 0;
    if (png_get_valid(png_, info_, PNG_INFO_sRGB) || !png_get_gAMA_fixed(png_, info_, &gamma)) return;
    if (std::abs(gamma - 45455) > 50) gamma_ = gamma / 1e5;
  }

 private:
  static void on_error(png_structp png, png_const_charp message) {
    static_cast<PngFile*>(png_get_error_ptr(png))->message_ = message;
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}

  static void on_read(png_structp png, png_bytep to, std::size_t count) {
    std::string_view& rest = static_cast<PngFile*>(png_get_io_ptr(png))->rest_;
    if (count > rest.size()) png_error(png, "the file ends too early");
    std::memcpy(to, rest.data(), count);
    rest.remove_prefix(count);
  }

  void require(bool good) const {
    if (!good) fail_file(name_, "damaged PNG: " + readable(message_));
  }

  bool try_header() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_read_fn(png_, this, on_read);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_ALWAYS, reinterpret_cast<png_const_bytep>("cICP"), 1);
    png_read_info(png_, info_);
    return true;
  }

  bool try_rows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_expand_16(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xffff, PNG_FILLER_AFTER);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    if (png_get_rowbytes(png_, info_) != 8 * width()) png_error(png_, "rows of an unknown kind");
    png_read_image(png_, rows);
    png_read_end(png_, info_);
    return true;
  }

  /// \param transfer  a transfer function of ITU-T H.273
  void find_cicp(int transfer) {
    switch (transfer) {
      case 13:
        return;
      case 8:
        gamma_ = 1;
        return;
      case 4:
        gamma_ = 1 / 2.2;
        return;
      case 5:
        gamma_ = 1 / 2.8;
        return;
      default:
        fail_file(name_, "its cICP has the transfer function " + std::to_string(transfer) +
                             (transfer == 16   ? " (PQ)"
                              : transfer == 18 ? " (HLG)"
                                               : "") +
                             ", which is not read; convert the picture to sRGB");
    }
  }

  const std::string& name_;
  std::string_view rest_;
  std::string message_;
  double gamma_ = 0;  ///< exponent of the coding; 0 for sRGB
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

GrayImage parse_png(std::string_view bytes, const std::string& name, bool colours) {
  // Deflate expands a byte to at most 1032 bytes, each with eight pixels of one bit.
  constexpr std::uint64_t most_pixels_a_byte = 8 * 1032;
  PngFile file(bytes, name);
  file.read_header();
  check_size({"PNG", file.width(), file.height(), bytes.size(), most_pixels_a_byte}, name);
  file.find_coding();
  const std::vector<std::uint16_t> pixels = file.pixels();
  std::vector<double> light(1 << 16);
  for (std::size_t k = 0; k < light.size(); ++k) light[k] = file.light(static_cast<double>(k) / 65535);
  GrayImage image{file.width(), file.height(), std::vector<double>(pixels.size() / 4), {}};
  for (std::size_t k = 0; k < image.values.size(); ++k) {
    const std::uint16_t* const p = &pixels[4 * k];
    image.values[k] = 1 - p[3] / 65535.0 * (1 - luminance(light[p[0]], light[p[1]], light[p[2]]));
  }
  for (std::size_t c = 0; colours && c < 3; ++c) {
    image.channels[c].resize(image.values.size());
    for (std::size_t k = 0; k < image.values.size(); ++k)
      image.channels[c][k] =
          static_cast<float>(1 - pixels[4 * k + 3] / 65535.0 * (1 - light[pixels[4 * k + c]]));
  }
  return upright(std::move(image), file.orientation());
}

}  // namespace powercell::io
