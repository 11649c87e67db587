/// \file
/// Stream compaction on the device. Internal.
#pragma once

#include <cstdint>

#include "lib/primitives/scan.hpp"

namespace powercell {

/// Lists the entries of an array that have a wanted value. Enqueues without waiting.
class Compaction {
 public:
  /// Builds the kernels. \throw Error build_failed, opencl
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
