#include "apps/io/base64.hpp"

#include <algorithm>
#include <array>

namespace powercell::io {

void write_base64(AtomicFile& file, std::string_view bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    }
    const std::array<char, 4> text = {digits[group >> 18], digits[group >> 12 & 63],
                                      count > 1 ? digits[group >> 6 & 63] : '=',
                                      count > 2 ? digits[group & 63] : '='};
    file.write(std::string_view(text.data(), text.size()));
  }
}

}  // namespace powercell::io
