// Pictures have the light that their formats define, whatever their depth, coding and orientation.
#include <doctest/doctest.h>
#include <zlib.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
// jpeglib.h needs two of those above.
#include <jpeglib.h>

#include <algorithm>

#include "apps/io/read/image.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

namespace {

std::string big_endian(std::size_t value, int bytes) {
  std::string text;
  for (int k = bytes - 1; k >= 0; --k) text += static_cast<char>(value >> (8 * k) & 255);
  return text;
}

std::string chunk(const std::string& kind, const std::string& data) {
  const std::string both = kind + data;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(both.data()), static_cast<uInt>(both.size()));
  return big_endian(data.size(), 4) + both + big_endian(sum, 4);
}

struct Png {
  std::size_t width, height;
  int bits, colour;                     // 0 gray, 2 RGB, 4 gray with opacity, 6 RGB with opacity
  std::vector<std::size_t> channels;    // of all pixels
  std::string chunks = "", after = "";  // before and after the pixels
};

std::string bytes_of(const Png& png) {
  std::string raw;
  for (std::size_t y = 0, row = png.channels.size() / png.height; y < png.height; ++y) {
    raw += '\0';  // no filter
    for (std::size_t k = 0; k < row; ++k) raw += big_endian(png.channels[y * row + k], png.bits / 8);
  }
  std::string packed(compressBound(raw.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
           raw.size());
  packed.resize(size);
  const std::string header = big_endian(png.width, 4) + big_endian(png.height, 4) +
                             static_cast<char>(png.bits) + static_cast<char>(png.colour) +
                             std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + png.chunks + chunk("IDAT", packed) + png.after +
         chunk("IEND", "");
}

GrayImage read(const Png& png) {
  return parse_image(bytes_of(png), "f");
}

// IEC 61966-2-1
double light(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

const std::string srgb_chunk = chunk("sRGB", std::string(1, '\0'));
std::string gamma_chunk(unsigned hundred_thousandths) {
  return chunk("gAMA", big_endian(hundred_thousandths, 4));
}
std::string cicp_chunk(int transfer) {
  return chunk("cICP", std::string{1, static_cast<char>(transfer), 0, 1});
}

/// Exif data with a few other tags before the orientation.
std::string exif(int orientation, bool little) {
  const auto number = [&](std::size_t value, int bytes) {
    std::string text = big_endian(value, bytes);
    if (little) std::reverse(text.begin(), text.end());
    return text;
  };
  const auto entry = [&](std::size_t tag, std::size_t value) {
    return number(tag, 2) + number(3, 2) + number(1, 4) + number(value, 2) + std::string(2, '\0');
  };
  return (little ? "II" : "MM") + number(42, 2) + number(8, 4) + number(3, 2) + entry(0x0100, 6) +
         entry(0x0112, static_cast<std::size_t>(orientation)) + entry(0x0128, 2) + number(0, 4);
}

struct Jpeg {
  int width, height, channels;
  J_COLOR_SPACE space;                // of the pixels
  std::vector<unsigned char> pixels;  // rows from the top
  bool progressive = false, adobe = false;
  std::string exif = "";
  int sampling = 1;  // of the brightness, to the other channels
};

std::string bytes_of(const Jpeg& from) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &memory, &size);
  jpeg.image_width = static_cast<JDIMENSION>(from.width);
  jpeg.image_height = static_cast<JDIMENSION>(from.height);
  jpeg.input_components = from.channels;
  jpeg.in_color_space = from.space;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  jpeg.comp_info[0].h_samp_factor = jpeg.comp_info[0].v_samp_factor = from.sampling;
  if (from.progressive) jpeg_simple_progression(&jpeg);
  jpeg.write_Adobe_marker = from.adobe;
  jpeg_start_compress(&jpeg, TRUE);
  if (!from.exif.empty()) {
    const std::string marker = std::string("Exif\0\0", 6) + from.exif;
    jpeg_write_marker(&jpeg, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(marker.data()),
                      static_cast<unsigned>(marker.size()));
  }
  for (int y = 0; y < from.height; ++y) {
    auto* row = const_cast<JSAMPLE*>(&from.pixels[static_cast<std::size_t>(y * from.width * from.channels)]);
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::string bytes(reinterpret_cast<const char*>(memory), size);
  std::free(memory);
  return bytes;
}

/// A picture of one colour, 16 x 16 pixels.
Jpeg plain(J_COLOR_SPACE space, std::vector<unsigned char> colour) {
  Jpeg jpeg{16, 16, static_cast<int>(colour.size()), space, {}};
  for (int k = 0; k < 256; ++k) jpeg.pixels.insert(jpeg.pixels.end(), colour.begin(), colour.end());
  return jpeg;
}

void check_light(const Jpeg& jpeg, double expected) {
  const GrayImage image = parse_image(bytes_of(jpeg), "f");
  REQUIRE(image.values.size() == 256);
  // Rounding in the colour transform and the cosine transform: two steps of a channel.
  for (const double value : image.values) CHECK(value == doctest::Approx(expected).scale(1).epsilon(0.02));
}

}  // namespace

TEST_CASE("a gray of 16 bits without a colour tag is the gray of 8 bits that viewers show") {
  for (std::size_t gray = 0; gray < 256; ++gray) {
    const GrayImage shallow = read({1, 1, 8, 0, {gray}}), deep = read({1, 1, 16, 0, {257 * gray}});
    CHECK(shallow.values[0] == doctest::Approx(light(static_cast<double>(gray) / 255)).epsilon(1e-12));
    CHECK(deep.values[0] == shallow.values[0]);
  }
  // Between two grays of 8 bits nothing is rounded.
  CHECK(read({1, 1, 16, 0, {32768}}).values[0] == doctest::Approx(light(32768 / 65535.0)).epsilon(1e-12));
}

TEST_CASE("colours of 16 bits and their opacity") {
  const double half = light(0.2), third = light(0.6);
  const GrayImage image = read({1, 1, 16, 6, {13107, 39321, 65535, 26214}});
  CHECK(image.values[0] ==
        doctest::Approx(1 - 0.4 * (1 - (0.2126 * half + 0.7152 * third + 0.0722))).epsilon(1e-12));
  CHECK(read({1, 1, 8, 6, {51, 153, 255, 102}}).values[0] == image.values[0]);
  CHECK(read({1, 1, 16, 4, {0, 0}}).values[0] == 1);  // nothing but paper
}

TEST_CASE("the channels of an image are its linear light on white paper, turned like its luminance") {
  const auto is = [](double expected) { return doctest::Approx(expected).epsilon(1e-6); };
  const GrayImage image =
      parse_image(bytes_of(Png{2, 1, 8, 6, {51, 153, 255, 102, 0, 255, 102, 255}}), "f", true);
  CHECK(image.channels[0][0] == is(1 - 0.4 * (1 - light(0.2))));
  CHECK(image.channels[1][0] == is(1 - 0.4 * (1 - light(0.6))));
  CHECK(image.channels[2][0] == is(1));
  CHECK(image.channels[0][1] == is(0));
  CHECK(image.channels[1][1] == is(1));
  CHECK(image.channels[2][1] == is(light(0.4)));
  CHECK(read({1, 1, 8, 0, {51}}).channels[0].empty());
  for (const auto& [space, colour] : {std::pair{JCS_RGB, std::vector<unsigned char>{200, 90, 40}},
                                      std::pair{JCS_GRAYSCALE, std::vector<unsigned char>{120}}}) {
    const GrayImage jpeg = parse_image(bytes_of(plain(space, colour)), "f", true);
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected = light(colour[colour.size() == 3 ? c : 0] / 255.0);
      REQUIRE(jpeg.channels[c].size() == 256);
      for (const float value : jpeg.channels[c])
        CHECK(value == doctest::Approx(expected).scale(1).epsilon(0.02));
    }
  }
}

TEST_CASE("the chunks of a PNG that define its coding, in their order") {
  const double v = 20000 / 65535.0;
  const auto value = [&](const std::string& chunks) {
    return read({1, 1, 16, 0, {20000}, chunks}).values[0];
  };
  const auto is = [](double expected) { return doctest::Approx(expected).epsilon(1e-12); };
  CHECK(value("") == is(light(v)));
  CHECK(value(srgb_chunk) == is(light(v)));
  CHECK(value(gamma_chunk(45455)) == is(light(v)));  // beside sRGB in most files
  CHECK(value(gamma_chunk(100000)) == is(v));        // linear light
  CHECK(value(gamma_chunk(55556)) == is(std::pow(v, 1 / 0.55556)));
  CHECK(value(srgb_chunk + gamma_chunk(100000)) == is(light(v)));
  CHECK(value(cicp_chunk(8) + srgb_chunk) == is(v));
  CHECK(value(cicp_chunk(13) + gamma_chunk(100000)) == is(light(v)));
  CHECK(value(cicp_chunk(4)) == is(std::pow(v, 2.2)));
  CHECK(says(refusal([&] { value(cicp_chunk(16)); }), "transfer function 16 (PQ)"));
  // In 8 bits too.
  CHECK(read({1, 1, 8, 0, {51}, gamma_chunk(100000)}).values[0] == is(0.2));
}

TEST_CASE("gray, colours and inks in JPEG, progressive too") {
  for (const bool progressive : {false, true}) {
    const auto check = [&](Jpeg jpeg, double expected) {
      jpeg.progressive = progressive;
      check_light(jpeg, expected);
    };
    check(plain(JCS_GRAYSCALE, {128}), light(128 / 255.0));
    check(plain(JCS_GRAYSCALE, {255}), 1);
    check(plain(JCS_RGB, {200, 100, 50}),
          0.2126 * light(200 / 255.0) + 0.7152 * light(100 / 255.0) + 0.0722 * light(50 / 255.0));
    Jpeg halved = plain(JCS_RGB, {0, 255, 0});
    halved.sampling = 2;
    check(halved, 0.7152);
    // Ink: no cyan, half magenta, no yellow, a fifth of black.
    const double free = 204 / 255.0;
    const double ink = 0.2126 * light(free) + 0.7152 * light(127 / 255.0 * free) + 0.0722 * light(free);
    check(plain(JCS_CMYK, {0, 128, 0, 51}), ink);
    Jpeg adobe = plain(JCS_CMYK, {255, 127, 255, 204});
    adobe.adobe = true;
    check(adobe, ink);
  }
}

TEST_CASE("all eight orientations of Exif, in JPEG and PNG, in both byte orders") {
  // A stored picture of 3 x 2 blocks of different grays; the rows that a viewer shows are by the definition
  // in Exif 2.32: where the stored first row and first column are in the picture.
  const std::vector<std::vector<std::vector<int>>> shown = {
      {{0, 1, 2}, {3, 4, 5}},    // 1  top, left
      {{2, 1, 0}, {5, 4, 3}},    // 2  top, right
      {{5, 4, 3}, {2, 1, 0}},    // 3  bottom, right
      {{3, 4, 5}, {0, 1, 2}},    // 4  bottom, left
      {{0, 3}, {1, 4}, {2, 5}},  // 5  left, top
      {{3, 0}, {4, 1}, {5, 2}},  // 6  right, top
      {{5, 2}, {4, 1}, {3, 0}},  // 7  right, bottom
      {{2, 5}, {1, 4}, {0, 3}},  // 8  left, bottom
  };
  constexpr int block = 8;
  const auto gray = [](int k) { return 40 * k + 20; };
  Jpeg jpeg{3 * block, 2 * block, 1, JCS_GRAYSCALE, {}};
  Png png{3 * block, 2 * block, 8, 0, {}};
  for (int y = 0; y < jpeg.height; ++y)
    for (int x = 0; x < jpeg.width; ++x) {
      jpeg.pixels.push_back(static_cast<unsigned char>(gray(3 * (y / block) + x / block)));
      png.channels.push_back(jpeg.pixels.back());
    }
  const auto check = [&](const GrayImage& image, std::size_t orientation) {
    CAPTURE(orientation);
    const auto& rows = shown[orientation - 1];
    REQUIRE(image.width == block * rows[0].size());
    REQUIRE(image.height == block * rows.size());
    double worst = 0;
    for (std::size_t y = 0; y < image.height; ++y)
      for (std::size_t x = 0; x < image.width; ++x)
        worst = std::max(worst, std::abs(image.values[y * image.width + x] -
                                         light(gray(rows[y / block][x / block]) / 255.0)));
    CHECK(worst < 0.01);
  };
  for (std::size_t orientation = 1; orientation <= 8; ++orientation)
    for (const bool little : {false, true}) {
      const std::string data = exif(static_cast<int>(orientation), little);
      jpeg.exif = data;
      check(parse_image(bytes_of(jpeg), "f"), orientation);
      for (std::string Png::*const place : {&Png::chunks, &Png::after}) {
        Png with = png;
        with.*place = chunk("eXIf", data);
        check(read(with), orientation);
      }
    }
  // Exif data that ends within a tag, and an orientation that does not exist.
  jpeg.exif = exif(6, true).substr(0, 30);
  check(parse_image(bytes_of(jpeg), "f"), 1);
  jpeg.exif = exif(9, false);
  check(parse_image(bytes_of(jpeg), "f"), 1);
}

TEST_CASE("damaged pictures and others are refused by name") {
  Jpeg noise{64, 64, 1, JCS_GRAYSCALE, std::vector<unsigned char>(64 * 64)};
  for (std::size_t k = 0; k < noise.pixels.size(); ++k)
    noise.pixels[k] = static_cast<unsigned char>(k * k % 251);
  for (const bool progressive : {false, true}) {
    noise.progressive = progressive;
    const std::string bytes = bytes_of(noise);
    for (const double share : {0.1, 0.5, 0.9}) {
      const std::string cut =
          bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size())));
      CHECK(says(refusal([&] { parse_image(cut, "f"); }), "f: damaged JPEG: "));
    }
    std::string spoilt = bytes;
    for (std::size_t k = bytes.size() / 2; k < bytes.size() / 2 + 40; ++k)
      spoilt[k] = static_cast<char>(0xff);
    CHECK(says(refusal([&] { parse_image(spoilt, "f"); }), "f: damaged JPEG: "));
  }
  // 65,500 pixels square from a picture of 16: the size is in bytes 5 to 8 of the frame's header.
  std::string wide = bytes_of(plain(JCS_GRAYSCALE, {7}));
  wide.replace(wide.find("\xff\xc0") + 5, 4, "\xff\xdc\xff\xdc");
  CHECK(says(refusal([&] { parse_image(wide, "f"); }), "65500 x 65500 pixels are too many"));
  wide.replace(wide.find("\xff\xc0") + 5, 4, "\x20\x10\x20\x10");
  CHECK(says(refusal([&] { parse_image(wide, "f"); }), "bytes cannot hold 8208 x 8208 pixels"));

  const std::string png = bytes_of(Png{8, 8, 16, 0, std::vector<std::size_t>(64, 9)});
  CHECK(says(refusal([&] { parse_image(png.substr(0, png.size() - 20), "f"); }), "f: damaged PNG: "));
  CHECK(says(refusal([&] { parse_image("GIF89a, of all formats", "f"); }), "f: not a PNG or JPEG picture"));
}
