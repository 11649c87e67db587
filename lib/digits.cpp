#include "lib/digits.hpp"

#include <array>
#include <charconv>

namespace powercell {

std::string digits(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string digits(double value, int significant) {
  std::array<char, 32> text{};
  const std::to_chars_result end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, significant);
  return {text.data(), end.ptr};
}

}  // namespace powercell
