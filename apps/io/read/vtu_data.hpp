/// \file
/// Arrays of VTK's XML formats: numbers as text, base64 or raw bytes, plain or zlib-compressed.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

/// How a file stores the arrays that are not text.
struct VtuStorage {
  std::endian order = std::endian::little;
  std::size_t header_bytes = 4;  ///< of each number in the headers of arrays: 4 or 8
  bool compressed = false;
  std::string_view appended;  ///< after the underscore of AppendedData
  bool appended_raw = false;  ///< else base64
};

/// Bytes of one array. `text` begins with the array (base64: inline or appended).
/// \throw Error
std::string decode_vtu_base64(std::string_view text, const VtuStorage& storage, const std::string& name);
std::string decode_vtu_raw(std::string_view bytes, const VtuStorage& storage, const std::string& name);

/// \param type  VTK's name: "Float64", "Int32", ...
std::vector<double> vtu_doubles(std::string_view bytes, const std::string& type, const VtuStorage& storage,
                                const std::string& name);
std::vector<std::int64_t> vtu_integers(std::string_view bytes, const std::string& type,
                                       const VtuStorage& storage, const std::string& name);

}  // namespace powercell::io
