/// \file
/// Reads rows of a fixed capacity from the device without what is not in them. Internal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/primitives/scan.hpp"

namespace powercell {

/// Count → scan → write: a kernel leaves rows with room for a fixed number of entries and says how many are
/// in each; they are put one after the other in device memory, and only then read. A few rows are read as
/// they are and put together on the host: that is less than what eight launches cost. Of a CPU, which has
/// them in the host's memory, many rows can be taken where they are.
class RowReader {
 public:
  explicit RowReader(const std::shared_ptr<cl::Context>& context) : context_(context) {}

  /// Takes in how long the rows are, for the reads that follow.
  /// \param counts   per row, then a 0; undefined afterwards, to be kept for the reads
  /// \param offset   written: where the rows begin when put together, rows + 1
  /// \throw Error build_failed, opencl
  /// \param allow_map  whether rows may be taken where they are
  void read_counts(cl::Buffer<std::uint32_t>& counts, std::size_t capacity,
                   std::vector<std::uint32_t>& offset, bool allow_map);

  /// Whether these rows are to be taken where they are, by map(), not by the reads.
  bool maps() const { return maps_; }
  /// Rows `capacity` entries apart, until unmap(). Kernels must not write to them before.
  template <class T>
  const T* map(const cl::RawBuffer& rows) {
    return reinterpret_cast<const T*>(mappings_.emplace_back(rows, rows_ * capacity_ * sizeof(T)).data());
  }
  void unmap();

  /// Reads rows of entries of `width` values each.
  void read(const cl::Buffer<std::int32_t>& rows, std::size_t width, std::vector<std::int32_t>& to);
  void read(const cl::Buffer<std::uint32_t>& rows, std::size_t width, std::vector<std::uint32_t>& to);
  /// The same for reals of the device's precision, float or double.
  void read_reals(const cl::RawBuffer& rows, bool float32, std::size_t width, std::vector<double>& to);

 private:
  /// Puts rows together on the device.
  struct Packer {
    cl::Kernel pack;
    ExclusiveScan scan;
    cl::RawBuffer packed;
    explicit Packer(const std::shared_ptr<cl::Context>& context);
  };

  template <class T>
  void read_values(const cl::RawBuffer& rows, std::size_t width, std::vector<T>& to);
  /// Of few rows, as they are on the device. \param offset  of the rows put together
  template <class T>
  void read_few(const cl::RawBuffer& rows, std::size_t width, std::vector<T>& to);

  std::shared_ptr<cl::Context> context_;
  std::optional<Packer> packer_;  // of many rows
  std::vector<std::byte> raw_;
  std::vector<float> narrow_;
  std::vector<cl::Mapping> mappings_;
  cl_mem device_offset_ = nullptr;
  const std::vector<std::uint32_t>* offset_ = nullptr;
  bool few_ = false, maps_ = false;
  std::size_t rows_ = 0, capacity_ = 0, total_ = 0;
};

}  // namespace powercell
