/// \file
/// Reads only the used entries of fixed-capacity rows from the device.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/cl/transfers.hpp"
#include "lib/primitives/scan.hpp"

namespace powercell {

/// A kernel writes rows of fixed capacity and the number of entries of each. A scan of these numbers and a
/// copy pack the rows in device memory before they are read. Few rows are read as they are and packed on the
/// host, which is faster than eight launches. A CPU device has them in the host's memory, where many rows can
/// be mapped.
class RowReader {
 public:
  explicit RowReader(const std::shared_ptr<cl::Context>& context) : context_(context) {}

  /// Few rows of walls: enqueues the reads of what read_counts() and two calls of read() will want, so that
  /// these need not wait one by one. Of many rows does nothing.
  /// \param wall  reals of `real_bytes` each
  void read_ahead(cl::Reads& reads, const cl::Buffer<std::uint32_t>& counts, std::size_t capacity,
                  const cl::Buffer<std::int32_t>& border, const cl::RawBuffer& wall, std::size_t real_bytes);

  /// Reads the lengths of the rows, for the reads that follow.
  /// \param counts     lengths by row, then a 0; the reads use the buffer, whose content becomes undefined
  /// \param capacity   entries of a row
  /// \param offset     set to the beginnings of the packed rows, rows + 1
  /// \param allow_map  whether rows may be mapped
  /// \throw Error build_failed, opencl
  void read_counts(cl::Buffer<std::uint32_t>& counts, std::size_t capacity,
                   std::vector<std::uint32_t>& offset, bool allow_map);

  /// Whether these rows must be mapped instead of read.
  bool maps() const { return maps_; }
  /// Maps rows, `capacity` entries apart, until unmap(). Kernels must not write to them before that.
  template <class T>
  const T* map(const cl::RawBuffer& rows) {
    return reinterpret_cast<const T*>(mappings_.emplace_back(rows, rows_ * capacity_ * sizeof(T)).data());
  }
  void unmap();

  /// Reads rows of entries of `width` values into packed rows.
  void read(const cl::Buffer<std::int32_t>& rows, std::size_t width, std::vector<std::int32_t>& to);
  void read(const cl::Buffer<std::uint32_t>& rows, std::size_t width, std::vector<std::uint32_t>& to);
  /// The same for reals of the device's precision, float or double.
  void read_reals(const cl::RawBuffer& rows, bool float32, std::size_t width, std::vector<double>& to);

 private:
  /// Packs rows on the device.
  struct Packer {
    cl::Kernel pack;
    ExclusiveScan scan;
    cl::RawBuffer packed;
    explicit Packer(const std::shared_ptr<cl::Context>& context);
  };

  template <class T>
  void read_values(const cl::RawBuffer& rows, std::size_t width, std::vector<T>& to);
  /// A buffer that was read ahead; null if it was not.
  std::vector<std::byte>* ahead(cl_mem memory);
  /// Reads few rows and packs them on the host.
  template <class T>
  void read_few(const cl::RawBuffer& rows, std::size_t width, std::vector<T>& to);

  std::shared_ptr<cl::Context> context_;
  std::optional<Packer> packer_;  // made on first use
  struct Ahead {
    cl_mem memory = nullptr;
    std::vector<std::byte> bytes;
  };
  std::array<Ahead, 3> ahead_;  // counts, borders and walls; null once they are used
  std::vector<std::byte> raw_;
  std::vector<float> narrow_;
  std::vector<cl::Mapping> mappings_;
  cl_mem device_offset_ = nullptr;
  const std::vector<std::uint32_t>* offset_ = nullptr;
  bool few_ = false, maps_ = false;
  std::size_t rows_ = 0, capacity_ = 0, total_ = 0;
};

}  // namespace powercell
