/// \file
/// Values as colours, with what a legend says of them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/io/picture/palette.hpp"

namespace powercell::io {

/// What the colours of a picture mean.
struct Legend {
  enum class Mark {
    colour,     ///< a box of the colour
    no_value,   ///< a striped box
    hidden,     ///< a hollow dot
    duplicate,  ///< a cross
    none,       ///< text alone
  };
  struct Entry {
    Mark mark = Mark::colour;
    Colour colour;
    std::string text;
  };
  std::string title, unit;
  bool scale = false;  ///< numbers from low to high in the colours of scale_colour
  double low = 0, high = 0;
  bool whole = false;  ///< all numbers are
  std::vector<Entry> entries;
  bool empty() const { return !scale && entries.empty(); }
};

struct Colouring {
  std::vector<Colour> colour;   ///< n
  std::vector<char> has_value;  ///< n; empty if all have
  Legend legend;

  bool is_striped(std::size_t i) const { return !has_value.empty() && has_value[i] == 0; }
};

/// 0 at `low`, 1 at `high`.
/// \pre low < high
double share_of_range(double value, double low, double high);

/// Colours on a scale from the least to the greatest of the numbers that are shown.
/// \param values  n; those that are not numbers are missing
/// \param shown  n
Colouring colours_of_numbers(std::span<const double> values, const std::vector<char>& shown, bool whole);

/// Colours of the texts themselves, if all are "#rgb" or "#rrggbb", else one for each text, in their order.
/// Empty texts are missing.
/// \pre check_classes
Colouring colours_of_texts(std::span<const std::string_view> values, const std::vector<char>& shown);

/// \param column  for the message
/// \throw Error invalid_argument for more texts than can be told apart
void check_classes(std::span<const std::string_view> values, const std::string& column);

}  // namespace powercell::io
