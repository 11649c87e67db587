/// \file
/// Reads rows of a fixed capacity from the device without what is not in them. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/primitives/scan.hpp"

namespace powercell {

/// Count → scan → write: a kernel leaves rows with room for a fixed number of entries and says how many are
/// in each; they are put one after the other in device memory, and only then read.
class RowReader {
 public:
  /// Builds the kernels. \throw Error build_failed, opencl
  explicit RowReader(const std::shared_ptr<cl::Context>& context);

  /// Takes in how long the rows are, for the reads that follow.
  /// \param counts   per row, then a 0; replaced by where the rows begin when put together
  /// \param offset   written: the same on the host, rows + 1
  void begin(cl::Buffer<std::uint32_t>& counts, std::size_t capacity, std::vector<std::uint32_t>& offset);

  /// Reads rows of entries of `width` values each.
  void read(const cl::Buffer<std::int32_t>& rows, std::size_t width, std::vector<std::int32_t>& to);
  void read(const cl::Buffer<std::uint32_t>& rows, std::size_t width, std::vector<std::uint32_t>& to);
  /// The same for reals of the device's precision, float or double.
  void read_reals(const cl::RawBuffer& rows, bool float32, std::size_t width, std::vector<double>& to);

 private:
  template <class T>
  void read_values(cl_mem rows, std::size_t width, std::vector<T>& to);

  cl::Kernel pack_;
  ExclusiveScan scan_;
  cl::RawBuffer packed_;
  std::vector<float> narrow_;
  cl_mem offset_ = nullptr;
  std::size_t rows_ = 0, capacity_ = 0, total_ = 0;
};

}  // namespace powercell
