#include "lib/base/text.hpp"

#include <array>
#include <cctype>
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

std::string place_text(const double* point) {
  std::string text = "(";
  for (int k = 0; k < 3; ++k) {
    if (k > 0) text += ", ";
    text += digits(point[k], 9);
  }
  return text += ")";
}

std::string readable(std::string text, std::size_t most) {
  if (text.size() > most) text = text.substr(0, most) + "...";
  for (char& c : text)
    if (std::iscntrl(static_cast<unsigned char>(c))) c = '?';
  return text;
}

}  // namespace powercell
