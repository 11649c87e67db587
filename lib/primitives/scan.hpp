/// \file
/// Exclusive prefix sums on the device, and compaction by them.
#pragma once

#include <cstdint>

#include "lib/cl/program.hpp"

namespace powercell {

/// Enqueues without waiting. Owns its scratch memory, so all its scans must be in one in-order queue.
class ExclusiveScan {
 public:
  enum class Type { uint32, uint64 };
  /// Builds the kernels.
  /// \throw Error build_failed, opencl
  ExclusiveScan(const std::shared_ptr<cl::Context>& context, Type type);

  /// Replaces each of the first `count` values by the sum of those before it, modulo 2^32 or 2^64.
  /// If the last value is 0, the last sum is the total.
  /// \param local size of a work-group; 0 chooses by the device. The result does not depend on it.
  /// \throw Error out_of_device_memory, opencl
  void enqueue(cl_mem values, std::uint32_t count, std::size_t local = 0);

 private:
  void scan_level(cl_mem values, std::uint32_t from, std::uint32_t count, std::uint32_t to,
                  std::size_t local);

  std::size_t value_bytes_;
  cl::Kernel sum_, scan_;
  cl::RawBuffer sums_;  // of the tiles, level by level
};

/// Lists the entries of an array that have a wanted value. Enqueues without waiting.
class Compaction {
 public:
  /// Builds the kernels.
  /// \throw Error build_failed, opencl
  explicit Compaction(const std::shared_ptr<cl::Context>& context);

  /// \param values   count uints
  /// \param indices  output: the k with values[k] == wanted, ascending, the first `room` of them
  /// \param found    output: one uint, the number of all of them
  /// \param done     the event of the last command, if not null
  /// \throw Error out_of_device_memory, opencl
  void enqueue(cl_mem values, std::uint32_t count, std::uint32_t wanted, cl_mem indices, std::uint32_t room,
               cl_mem found, std::size_t local = 0, cl_event* done = nullptr);

 private:
  cl::Kernel mark_, list_;
  ExclusiveScan scan_;
  cl::RawBuffer places_;
};

}  // namespace powercell
