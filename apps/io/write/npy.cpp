#include "apps/io/write/npy.hpp"

#include <fmt/format.h>

#include <bit>

#include "apps/io/read/file.hpp"

namespace powercell::io {

std::string npy_type(std::string_view type) {
  const bool one_byte = type.ends_with('1');
  return fmt::format("'{}{}'", one_byte ? '|' : std::endian::native == std::endian::little ? '<' : '>', type);
}

NpyWriter::NpyWriter(const std::string& path, std::string_view type, std::uint64_t rows) : file_(path) {
  constexpr std::size_t before = 10, alignment = 64;  // bytes before the header; of the first number
  std::string header = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': ({},), }}", type, rows);
  header.append(alignment - (before + header.size() + 1) % alignment, ' ');
  header += '\n';
  file_.write(std::string_view("\x93NUMPY\x01\x00", 8));
  file_.raw(static_cast<std::uint16_t>(header.size()));
  file_.write(header);
}

bool is_npy(const std::string& path) {
  return lower_extension(path) == ".npy";
}

}  // namespace powercell::io
