/// \file
/// Radix sort on the device.
#pragma once

#include <cstdint>

#include "lib/primitives/scan.hpp"

namespace powercell {

/// A stable radix sort of (64-bit key, 32-bit value) pairs. Enqueues without waiting.
class RadixSort {
 public:
  /// How the work is divided; results do not depend on it. 0 chooses by the device.
  struct Shape {
    unsigned digit_bits = 0;  ///< 4 or 8
    std::uint32_t tiles = 0;  ///< largest number of work-items of a pass
    std::size_t local = 0;    ///< size of a work-group
  };
  /// Builds the kernels.
  /// \throw Error build_failed, opencl
  explicit RadixSort(const std::shared_ptr<cl::Context>& context) : RadixSort(context, Shape{}) {}
  RadixSort(const std::shared_ptr<cl::Context>& context, Shape shape);

  /// Sorts the first `count` pairs by ascending key; equal keys keep their order.
  /// \param keys  ulong
  /// \param values  uint
  /// \param bits    all keys must be below 2^bits; fewer bits need fewer passes
  /// \throw Error out_of_device_memory, opencl
  void enqueue(cl_mem keys, cl_mem values, std::uint32_t count, unsigned bits = 64);

 private:
  Shape shape_;
  cl::Kernel count_, scatter_;
  ExclusiveScan scan_;
  cl::RawBuffer keys_, values_, counts_;
};

}  // namespace powercell
