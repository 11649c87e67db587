// Colours of numbers and classes, the ticks of a scale, and legends.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "apps/io/picture/colour_scales.hpp"
#include "apps/io/picture/colouring.hpp"
#include "apps/io/picture/legend.hpp"
#include "apps/io/picture/round_ticks.hpp"

using namespace powercell;

namespace {

using Triple = std::array<double, 3>;

double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// CIELAB (1976) with the white of sRGB, of a colour as it is, or without the cones for red, green or blue.
// The pictures choose their colours in another space.
Triple cielab(io::Colour colour, int missing_cone) {
  constexpr std::array<std::array<double, 9>, 3> without = {
      {{0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998},
       {0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881},
       {1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900}}};
  Triple rgb{linear(colour.red), linear(colour.green), linear(colour.blue)};
  if (missing_cone >= 0) {
    const auto& m = without[static_cast<std::size_t>(missing_cone)];
    Triple seen{};
    for (std::size_t k = 0; k < 3; ++k)
      seen[k] = std::clamp(m[3 * k] * rgb[0] + m[3 * k + 1] * rgb[1] + m[3 * k + 2] * rgb[2], 0.0, 1.0);
    rgb = seen;
  }
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16 / 116.0; };
  const double x = f((0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2]) / 0.9505);
  const double y = f(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
  const double z = f((0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2]) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double apart(const Triple& a, const Triple& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Whether a number is 1, 2 or 5 times a power of ten, up to rounding.
bool is_round(double step) {
  const double digit = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
  for (const double round : {1.0, 2.0, 5.0})
    if (std::abs(digit / round - 1) < 1e-6) return true;
  return false;
}

std::vector<char> all_shown(std::size_t n) {
  return std::vector<char>(n, 1);
}

}  // namespace

TEST_CASE("the scale becomes lighter in even steps, for those blind to a colour too") {
  constexpr int steps = 16;
  for (int eye = -1; eye < 3; ++eye) {
    CAPTURE(eye);
    const Triple first = cielab(io::scale_colour(0), eye), last = cielab(io::scale_colour(1), eye);
    const double mean = (last[0] - first[0]) / steps;
    CHECK(mean > 3);
    for (int k = 0; k < steps; ++k) {
      CAPTURE(k);
      const Triple here = cielab(io::scale_colour(k / double(steps)), eye),
                   next = cielab(io::scale_colour((k + 1) / double(steps)), eye);
      CHECK(next[0] - here[0] > (eye < 0 ? 0.8 : 0.45) * mean);
      CHECK(next[0] - here[0] < (eye < 0 ? 1.2 : 1.5) * mean);
      if (eye < 0)
        CHECK(apart(here, next) <
              1.6 * apart(cielab(io::scale_colour(0.5), eye), cielab(io::scale_colour(0.5625), eye)));
    }
  }
}

TEST_CASE("classes have colours that can be told apart, with any cones") {
  for (const std::size_t count : {2u, 7u, 8u, 12u, 20u, 40u}) {
    const std::vector<io::Colour> colours = io::class_colours(count);
    REQUIRE(colours.size() == count);
    const double least = count <= 8 ? 8 : count <= 20 ? 5 : 2.3;  // 2.3 is just noticeable
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j)
        for (int eye = -1; eye < 2; ++eye) {
          CAPTURE(count);
          CAPTURE(i);
          CAPTURE(j);
          CAPTURE(eye);
          CHECK(apart(cielab(colours[i], eye), cielab(colours[j], eye)) > least);
        }
      CHECK(apart(cielab(colours[i], -1), cielab(io::no_value, -1)) > 8);
      CHECK(colours[i] == io::class_colours(io::most_classes)[i]);
    }
  }
}

TEST_CASE("ticks are round numbers within the range, two to seven of them, and labels say what they are") {
  std::mt19937_64 random(5);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int k = 0; k < 4000; ++k) {
    const bool whole = k % 3 == 0;
    double low = uniform(-1, 1) * std::pow(10, uniform(-9, 12)), high = low + std::pow(10, uniform(-9, 12));
    if (whole) low = std::floor(low), high = low + 1 + std::floor(high - low);
    if (!(high - low > 1e-4 * std::max(std::abs(low), std::abs(high)))) continue;
    CAPTURE(low);
    CAPTURE(high);
    const io::Ticks ticks = io::round_ticks(low, high, whole, 7);
    REQUIRE(ticks.at.size() >= 2);
    CHECK(ticks.at.size() <= 7);
    CHECK(ticks.at.front() >= low);
    CHECK(ticks.at.back() <= high);
    REQUIRE(ticks.label.size() == ticks.at.size());
    const double step = ticks.at[1] - ticks.at[0];
    CHECK(is_round(step));
    CHECK(ticks.exponent % 3 == 0);
    for (std::size_t t = 0; t < ticks.at.size(); ++t) {
      if (whole) CHECK(ticks.at[t] == std::round(ticks.at[t]));
      const double multiple = ticks.at[t] / step;
      CHECK(std::abs(multiple - std::round(multiple)) < 1e-4);
      // The label is exact, not rounded to fewer digits.
      const double said = std::stod(ticks.label[t]) * std::pow(10, ticks.exponent);
      CHECK(std::abs(said - ticks.at[t]) < 1e-4 * step);
      if (t > 0) CHECK(ticks.label[t] != ticks.label[t - 1]);
    }
    // The next tick on either side would be outside.
    CHECK(ticks.at.front() - step < low + 1e-6 * step);
    CHECK(ticks.at.back() + step > high - 1e-6 * step);
  }
  CHECK(io::power_of_ten(0).empty());
  CHECK(io::power_of_ten(-12) == "×10⁻¹²");
}

TEST_CASE(
    "numbers run from the first colour to the last; missing ones and cells that are not shown do not count") {
  const double nan = std::nan("");
  const std::vector<double> values = {3, nan, 1, 2, 900, -4};
  const std::vector<char> shown = {1, 1, 1, 1, 0, 1};
  const io::Colouring made = io::colours_of_numbers(values, shown, false);
  CHECK(made.legend.scale);
  CHECK(made.legend.low == -4);
  CHECK(made.legend.high == 3);
  CHECK(made.colour[0] == io::scale_colour(1));
  CHECK(made.colour[5] == io::scale_colour(0));
  CHECK(made.colour[3] == io::scale_colour(6 / 7.0));
  CHECK(made.colour[1] == io::no_value);
  CHECK(made.is_striped(1));
  CHECK_FALSE(made.is_striped(0));
  REQUIRE(made.legend.entries.size() == 1);
  CHECK(made.legend.entries[0].mark == io::Legend::Mark::no_value);
  CHECK(made.legend.entries[0].text == "no value (1)");
  // A single value has no scale, and the whole range of numbers has one.
  const io::Colouring same = io::colours_of_numbers(std::vector<double>{7, 7}, all_shown(2), false);
  CHECK_FALSE(same.legend.scale);
  REQUIRE(same.legend.entries.size() == 1);
  CHECK(same.legend.entries[0].text == "7");
  CHECK(same.legend.entries[0].colour == same.colour[0]);
  const io::Colouring wide =
      io::colours_of_numbers(std::vector<double>{-1.7e308, 1.7e308, 0}, all_shown(3), false);
  CHECK(wide.colour[0] == io::scale_colour(0));
  CHECK(wide.colour[1] == io::scale_colour(1));
  CHECK(wide.colour[2] == io::scale_colour(0.5));
  CHECK_FALSE(io::lay_out(wide.legend, 800, 800).empty());
}

TEST_CASE("texts have a colour each, or are colours themselves") {
  const std::vector<std::string_view> texts = {"b", "a", "", "b"};
  const io::Colouring made = io::colours_of_texts(texts, all_shown(4));
  CHECK(made.colour[0] == made.colour[3]);
  CHECK_FALSE(made.colour[0] == made.colour[1]);
  CHECK(made.is_striped(2));
  REQUIRE(made.legend.entries.size() == 3);
  CHECK(made.legend.entries[0].text == "a");
  CHECK(made.legend.entries[0].colour == made.colour[1]);
  CHECK(made.legend.entries[2].mark == io::Legend::Mark::no_value);
  const std::vector<std::string_view> colours = {"#3A6b9c", "#f08", ""};
  const io::Colouring own = io::colours_of_texts(colours, all_shown(3));
  CHECK(own.colour[0] == io::Colour{0x3a, 0x6b, 0x9c});
  CHECK(own.colour[1] == io::Colour{0xff, 0x00, 0x88});
  CHECK(own.is_striped(2));
  CHECK(own.legend.entries.size() == 1);
  // One text that is none makes all of them classes.
  const std::vector<std::string_view> mixed = {"#3a6b9c", "#f0", "red"};
  CHECK(io::colours_of_texts(mixed, all_shown(3)).legend.entries.size() == 3);
}

TEST_CASE("more texts than colours are refused, more colours are not") {
  std::vector<std::string> made;
  for (int k = 0; k < 60; ++k) made.push_back("#0000" + std::to_string(10 + k));
  std::vector<std::string_view> values(made.begin(), made.end());
  CHECK_NOTHROW(io::check_classes(values, "c"));
  values[0] = "red";
  CHECK_THROWS_WITH(io::check_classes(values, "c"), doctest::Contains("60 different texts, of which 40"));
  values.resize(40);
  CHECK_NOTHROW(io::check_classes(values, "c"));
}

TEST_CASE("a legend fits into half of its picture, and nothing in it overlaps") {
  for (const std::size_t classes : {0u, 1u, 3u, 12u, 40u})
    for (const auto& size : {std::pair{1600, 1600}, {200, 200}, {4000, 300}, {300, 2000}}) {
      const int width = size.first, height = size.second;
      CAPTURE(classes);
      CAPTURE(width);
      CAPTURE(height);
      io::Legend legend{"people in thousands and more than fit", "m²", classes == 0, 0.001, 7.2e6, false, {}};
      for (std::size_t k = 0; k < classes; ++k)
        legend.entries.push_back(
            {io::Legend::Mark::colour, {}, "class of number " + std::to_string(k * k * k)});
      legend.entries.push_back({io::Legend::Mark::no_value, {}, "no value (3)"});
      legend.entries.push_back({io::Legend::Mark::hidden, {}, "hidden (12)"});
      const io::LegendScene scene = io::lay_out(legend, width, height);
      CHECK(scene.width <= width / 2.0);
      CHECK(scene.height <= height);
      CHECK(scene.boxes.size() == classes + 2);
      struct Rectangle {
        double left, top, right, bottom;
      };
      std::vector<Rectangle> all;
      for (const auto& text : scene.texts)
        all.push_back({text.x, text.y - 0.6 * text.size, text.x + text.width, text.y + 0.6 * text.size});
      for (const auto& box : scene.boxes) all.push_back({box.x, box.y, box.x + box.side, box.y + box.side});
      if (classes == 0)
        all.push_back(
            {scene.bar.x, scene.bar.y, scene.bar.x + scene.bar.width, scene.bar.y + scene.bar.height});
      for (std::size_t i = 0; i < all.size(); ++i) {
        CHECK(all[i].left >= 0);
        CHECK(all[i].top >= 0);
        CHECK(all[i].right <= scene.width);
        CHECK(all[i].bottom <= scene.height);
        for (std::size_t j = 0; j < i; ++j)
          CHECK((all[i].right <= all[j].left || all[j].right <= all[i].left || all[i].bottom <= all[j].top ||
                 all[j].bottom <= all[i].top));
      }
    }
}

TEST_CASE("ticks stand beside the colours of their numbers") {
  const io::Legend legend{"x", "", true, -3, 47, false, {}};
  const io::LegendScene scene = io::lay_out(legend, 900, 700);
  const io::Ticks ticks = io::round_ticks(-3, 47, false, 7);
  REQUIRE(scene.ticks.size() == ticks.at.size());
  for (std::size_t k = 0; k < ticks.at.size(); ++k) {
    const double from_bottom = (scene.bar.y + scene.bar.height - scene.ticks[k].y) / scene.bar.height;
    CHECK(from_bottom == doctest::Approx((ticks.at[k] + 3) / 50));
    const double at = from_bottom * static_cast<double>(scene.bar.stops.size() - 1);
    const auto below =
        static_cast<std::size_t>(std::min(at, static_cast<double>(scene.bar.stops.size() - 2)));
    const io::Colour shown =
        io::mix(scene.bar.stops[below], scene.bar.stops[below + 1], at - static_cast<double>(below));
    const io::Colour meant = io::scale_colour((ticks.at[k] + 3) / 50);
    CHECK(std::abs(shown.red - meant.red) <= 3);
    CHECK(std::abs(shown.green - meant.green) <= 3);
    CHECK(std::abs(shown.blue - meant.blue) <= 3);
  }
}
