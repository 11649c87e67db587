/// \file
/// Round numbers along a scale.
#pragma once

#include <string>
#include <vector>

namespace powercell::io {

struct Ticks {
  std::vector<double> at;          ///< ascending
  std::vector<std::string> label;  ///< of at / 10^exponent
  int exponent = 0;                ///< a multiple of 3; 0 for numbers that are short without it
};

/// Multiples of 1, 2 or 5 times a power of ten from low to high, two at least.
/// \pre low < high, both finite
/// \param whole  only whole numbers; low and high are whole
/// \param most  their largest number, 6 at least
Ticks round_ticks(double low, double high, bool whole, int most);

/// "×10⁶", for a title; empty for an exponent of 0.
std::string power_of_ten(int exponent);

}  // namespace powercell::io
