#include "apps/io/picture/round_ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace powercell::io {
namespace {

struct RoundStep {
  int digit = 1, exponent = 0;  // digit * 10^exponent
  // The k-th multiple, correctly rounded where the power is a whole number.
  double times(double k) const {
    return exponent >= 0 ? k * digit * std::pow(10, exponent) : k * digit / std::pow(10, -exponent);
  }
};

// The smallest step that leaves at most `most` multiples.
RoundStep step_for(double low, double high, bool whole, int most) {
  const double least = high / (most - 1) - low / (most - 1);
  RoundStep step{1, static_cast<int>(std::floor(std::log10(least))) - 1};
  if (whole) step.exponent = std::max(step.exponent, 0);
  while (step.times(1) < least)
    step =
        step.digit == 5 ? RoundStep{1, step.exponent + 1} : RoundStep{step.digit == 1 ? 2 : 5, step.exponent};
  return step;
}

}  // namespace

Ticks round_ticks(double low, double high, bool whole, int most) {
  const RoundStep step = step_for(low, high, whole, most);
  Ticks ticks;
  const double first = std::ceil(low / step.times(1) - 1e-9), last = std::floor(high / step.times(1) + 1e-9);
  for (double k = first; k <= last; ++k)
    ticks.at.push_back(std::clamp(step.times(k == 0 ? 0 : k), low, high));
  double largest = 0;
  for (const double at : ticks.at) largest = std::max(largest, std::abs(at));
  const int magnitude = largest > 0 ? static_cast<int>(std::floor(std::log10(largest))) : 0;
  if (magnitude >= 6 || magnitude <= -3) ticks.exponent = 3 * static_cast<int>(std::floor(magnitude / 3.0));
  const int decimals = std::max(0, ticks.exponent - step.exponent);
  for (double k = first; k <= last; ++k) {
    const RoundStep shown{step.digit, step.exponent - ticks.exponent};
    ticks.label.push_back(fmt::format("{:.{}f}", shown.times(k == 0 ? 0 : k), decimals));
  }
  return ticks;
}

std::string power_of_ten(int exponent) {
  static constexpr const char* raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (exponent == 0) return {};
  std::string text = "×10";
  for (const char c : std::to_string(exponent)) text += c == '-' ? "⁻" : raised[c - '0'];
  return text;
}

}  // namespace powercell::io
