#include "apps/io/printable.hpp"

namespace powercell::io {

std::string printable(const std::string& text) {
  std::string safe;
  for (std::size_t k = 0; k < text.size();) {
    const auto byte = [&](std::size_t at) {
      return static_cast<unsigned char>(at < text.size() ? text[at] : 0);
    };
    const unsigned char first = byte(k);
    const std::size_t length = first < 0x80       ? 1
                               : first >> 5 == 6  ? 2
                               : first >> 4 == 14 ? 3
                               : first >> 3 == 30 ? 4
                                                  : 0;
    bool valid = length > 0 && !(length == 2 && first < 0xc2) && !(length == 4 && first > 0xf4) &&
                 first >= 0x20 && first != 0x7f;
    for (std::size_t more = 1; more < length; ++more) valid &= byte(k + more) >> 6 == 2;
    if (length == 3)  // overlong, surrogates, and two that XML does not allow
      valid &= !(first == 0xe0 && byte(k + 1) < 0xa0) && !(first == 0xed && byte(k + 1) > 0x9f) &&
               !(first == 0xef && byte(k + 1) == 0xbf && byte(k + 2) >= 0xbe);
    if (length == 4)
      valid &= !(first == 0xf0 && byte(k + 1) < 0x90) && !(first == 0xf4 && byte(k + 1) > 0x8f);
    if (valid)
      safe.append(text, k, length);
    else
      safe += "\xef\xbf\xbd";
    k += valid ? length : 1;
  }
  return safe;
}

std::string xml_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string one_line(std::string text) {
  for (char& c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < ' ' || code == 0x7f) c = '?';
  }
  return text;
}

std::string readable(std::string text) {
  constexpr std::size_t most = 400;
  if (text.size() > most) text = text.substr(0, most) + "...";
  return one_line(std::move(text));
}

std::string with_commas(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t place = digits.size(); place > 3;) {
    place -= 3;
    digits.insert(place, ",");
  }
  return digits;
}

}  // namespace powercell::io
