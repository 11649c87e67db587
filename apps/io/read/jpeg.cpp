#include <cstddef>
#include <cstdio>
// jpeglib.h needs the two above.
#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdint>
#include <vector>

#include "apps/io/picture/palette.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/image_parts.hpp"

namespace powercell::io {
namespace {

/// libjpeg on bytes in memory. Its errors come by longjmp, past the frames of the functions below that call
/// it: those frames hold no objects with destructors.
class JpegFile {
 public:
  JpegFile(std::string_view bytes, const std::string& name) : name_(name) {
    jpeg_.err = jpeg_std_error(&errors_);
    jpeg_.client_data = this;
    errors_.error_exit = on_error;
    errors_.emit_message = on_warning;
    progress_.progress_monitor = on_progress;
    require(try_create(bytes));
  }
  ~JpegFile() { jpeg_destroy_decompress(&jpeg_); }
  JpegFile(const JpegFile&) = delete;
  JpegFile& operator=(const JpegFile&) = delete;

  void read_header() { require(try_header()); }
  std::size_t width() const { return jpeg_.image_width; }
  std::size_t height() const { return jpeg_.image_height; }
  bool arithmetic() const { return jpeg_.arith_code != FALSE; }

  /// Chooses one of the three kinds of pixels below.
  void choose_channels() {
    switch (jpeg_.jpeg_color_space) {
      case JCS_GRAYSCALE:
        jpeg_.out_color_space = JCS_GRAYSCALE;
        break;
      case JCS_RGB:
      case JCS_YCbCr:
        jpeg_.out_color_space = JCS_RGB;
        break;
      case JCS_CMYK:
      case JCS_YCCK:
        jpeg_.out_color_space = JCS_CMYK;
        break;
      default:
        fail_file(name_, "a JPEG with " + std::to_string(jpeg_.num_components) +
                             " channels, which are neither gray, RGB nor CMYK");
    }
  }

  /// \param image  output: its luminance, and its channels if they are wanted
  void read_pixels(GrayImage& image, bool colours) {
    require(try_start());
    image.values.reserve(width() * height());
    if (colours)
      for (std::vector<float>& channel : image.channels) channel.reserve(width() * height());
    const auto samples = static_cast<std::size_t>(jpeg_.output_components);
    std::vector<JSAMPLE> row(width() * samples);
    for (std::size_t y = 0; y < height(); ++y) {
      require(try_row(row.data()));
      for (std::size_t x = 0; x < width(); ++x) {
        const std::array<double, 3> light = light_of(&row[x * samples]);
        const bool gray = jpeg_.out_color_space == JCS_GRAYSCALE;
        image.values.push_back(gray ? light[0] : luminance(light[0], light[1], light[2]));
        for (std::size_t c = 0; colours && c < 3; ++c)
          image.channels[c].push_back(static_cast<float>(light[c]));
      }
    }
    require(try_finish());
  }

  /// To be called before the pixels are read, after which libjpeg forgets it.
  int orientation() const {
    constexpr std::string_view title("Exif\0\0", 6);
    for (const jpeg_marker_struct* marker = jpeg_.marker_list; marker; marker = marker->next) {
      const std::string_view data(reinterpret_cast<const char*>(marker->data), marker->data_length);
      if (data.starts_with(title)) return exif_orientation(data.substr(title.size()));
    }
    return 1;
  }

 private:
  static void on_error(j_common_ptr jpeg) {
    std::longjmp(static_cast<JpegFile*>(jpeg->client_data)->jump_, 1);
  }

  /// libjpeg warns of damage and fills in gray. A few of its warnings concern no pixel.
  static void on_warning(j_common_ptr jpeg, int level) {
    constexpr std::array harmless = {JWRN_ADOBE_XFORM, JWRN_EXTRANEOUS_DATA, JWRN_JFIF_MAJOR};
    if (level < 0 && std::ranges::find(harmless, jpeg->err->msg_code) == harmless.end()) on_error(jpeg);
  }

  /// A few bytes are a scan of a progressive file, which takes time in proportion to all pixels.
  static void on_progress(j_common_ptr jpeg) {
    constexpr int most_scans = 1000;
    if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number < most_scans) return;
    jpeg->err->msg_code = JERR_BAD_PROGRESSION;
    on_error(jpeg);
  }

  void require(bool good) {
    if (good) return;
    char message[JMSG_LENGTH_MAX];
    errors_.format_message(reinterpret_cast<j_common_ptr>(&jpeg_), message);
    fail_file(name_, "damaged JPEG: " + readable(message));
  }

  bool try_create(std::string_view bytes) {
    if (setjmp(jump_)) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_.progress = &progress_;
    jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_save_markers(&jpeg_, JPEG_APP0 + 1, 0xffff);
    return true;
  }
  bool try_header() {
    if (setjmp(jump_)) return false;
    jpeg_read_header(&jpeg_, TRUE);
    return true;
  }
  bool try_start() {
    if (setjmp(jump_)) return false;
    jpeg_start_decompress(&jpeg_);
    return true;
  }
  bool try_row(JSAMPROW row) {
    if (setjmp(jump_)) return false;
    jpeg_read_scanlines(&jpeg_, &row, 1);
    return true;
  }
  bool try_finish() {
    if (setjmp(jump_)) return false;
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

  /// Linear red, green and blue.
  std::array<double, 3> light_of(const JSAMPLE* p) const {
    if (jpeg_.out_color_space == JCS_GRAYSCALE) return {to_linear(p[0]), to_linear(p[0]), to_linear(p[0])};
    if (jpeg_.out_color_space == JCS_RGB) return {to_linear(p[0]), to_linear(p[1]), to_linear(p[2])};
    // Without a profile of the inks: the paper's share that each leaves free. Adobe's files hold those
    // shares.
    const auto free = [&](int k) { return (jpeg_.saw_Adobe_marker ? p[k] : 255 - p[k]) / 255.0; };
    return {to_linear(free(0) * free(3)), to_linear(free(1) * free(3)), to_linear(free(2) * free(3))};
  }

  const std::string& name_;
  jpeg_decompress_struct jpeg_{};
  jpeg_error_mgr errors_{};
  jpeg_progress_mgr progress_{};
  std::jmp_buf jump_{};
};

}  // namespace

GrayImage parse_jpeg(std::string_view bytes, const std::string& name, bool colours) {
  // A Huffman code has a bit at least, and a block of 8 x 8 pixels has one. Arithmetic coding has no such
  // bound.
  JpegFile file(bytes, name);
  file.read_header();
  const std::uint64_t most_pixels_a_byte = file.arithmetic() ? std::uint64_t{1} << 28 : 8 * 64;
  check_size({"JPEG", file.width(), file.height(), bytes.size(), most_pixels_a_byte}, name);
  file.choose_channels();
  const int orientation = file.orientation();
  GrayImage image{file.width(), file.height(), {}, {}};
  file.read_pixels(image, colours);
  return upright(std::move(image), orientation);
}

}  // namespace powercell::io
