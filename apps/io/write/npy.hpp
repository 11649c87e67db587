/// \file
/// Arrays of NumPy, written row by row.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "apps/io/atomic_file.hpp"

namespace powercell::io {

/// A type of numbers as a header has it, in the order of bytes of this machine: "'<f8'" for "f8".
std::string npy_type(std::string_view type);

/// An .npy, version 1, of one dimension, replaced as a whole or not at all.
class NpyWriter {
 public:
  /// \param type  of npy_type(), or a list of fields "[('a', '<f8'), ('b', '|u1')]"
  /// \param rows  that will be written
  /// \throw Error write_failed
  NpyWriter(const std::string& path, std::string_view type, std::uint64_t rows);

  /// A number, or a field of a row, of the size that the type says.
  template <class Number>
  void number(Number value) {
    file_.raw(value);
  }
  /// \throw Error write_failed
  void commit() { file_.commit(); }

 private:
  AtomicFile file_;
};

/// Whether a file is one by its name.
bool is_npy(const std::string& path);

}  // namespace powercell::io
