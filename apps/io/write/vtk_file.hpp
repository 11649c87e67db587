/// \file
/// VTK's XML files: elements, attributes and compressed arrays.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "apps/io/atomic_file.hpp"

namespace powercell::io {

/// A VTK XML file. Arrays are written inline as base64 of zlib blocks, so that the file is well-formed XML
/// (with VTK's raw appended data it would not be) and every reader of the format accepts it.
class VtkFile {
 public:
  /// \param type "UnstructuredGrid", "PolyData" or "PUnstructuredGrid"
  VtkFile(const std::string& path, std::string_view type);

  /// Opens an element.
  /// \param attributes  e.g. `NumberOfPoints="8"`, already escaped
  void open(std::string_view element, std::string_view attributes = {});
  void close(std::string_view element);
  /// An element without content.
  void empty(std::string_view element, std::string_view attributes);

  template <class T>
  void array(std::string_view name, std::span<const T> values, int components = 1) {
    array_bytes(name, type_name<T>(), components,
                {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  /// Ends the file and gives it its name.
  /// \throw Error write_failed
  void finish();

 private:
  template <class T>
  static constexpr std::string_view type_name() {
    if constexpr (std::is_same_v<T, double>)
      return "Float64";
    else if constexpr (std::is_same_v<T, std::int64_t>)
      return "Int64";
    else if constexpr (std::is_same_v<T, std::uint32_t>)
      return "UInt32";
    else {
      static_assert(std::is_same_v<T, std::uint8_t>);
      return "UInt8";
    }
  }
  void array_bytes(std::string_view name, std::string_view type, int components, std::string_view bytes);

  AtomicFile file_;
  std::string type_;
};

}  // namespace powercell::io
