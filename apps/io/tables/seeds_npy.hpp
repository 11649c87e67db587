/// \file
/// Rows of seeds in a NumPy array.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "apps/io/read/bytes.hpp"

namespace powercell::io {

/// An .npy, versions 1 to 3: real or integer numbers, shape (n, d) or (n, d + 1), of which some rows are read
/// at a time.
class NpySeeds {
 public:
  /// \param bytes  of the file; not copied
  /// \throw Error invalid_file
  NpySeeds(std::string_view bytes, int dimension, const std::string& name);

  std::uint64_t rows() const { return rows_; }
  /// Reads the rows first, first + 1, ...: as many as there are weights. Without a column of weights these
  /// are 0.
  /// \throw Error invalid_seed with the row and column of a number that is not finite
  void read(std::uint64_t first, std::span<double> positions, std::span<double> weights) const;

 private:
  std::string name_;
  const char* begin_;
  NumberType type_ = NumberType::f64;
  bool swapped_ = false, fortran_ = false;
  std::uint64_t rows_ = 0, columns_ = 0;
  std::size_t d_;
};

}  // namespace powercell::io
