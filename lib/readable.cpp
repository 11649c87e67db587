#include "lib/readable.hpp"

#include <cctype>

namespace powercell {

std::string readable(std::string text, std::size_t most) {
  if (text.size() > most) text = text.substr(0, most) + "...";
  for (char& c : text)
    if (std::iscntrl(static_cast<unsigned char>(c))) c = '?';
  return text;
}

}  // namespace powercell
