/// \file
/// The packed tree built on the device.
#pragma once

#include <cstdint>

#include "lib/cl/program.hpp"

namespace powercell {

/// PackedTree in device memory. Enqueues without waiting.
class DeviceTree {
 public:
  /// Builds the kernels.
  /// \param defines  Variant::defines() for the precision and dimension
  DeviceTree(const std::shared_ptr<cl::Context>& context, const std::vector<std::string>& defines);

  /// Builds the tree over seeds, or over boxes, in curve order.
  /// \param low, high  seed_t: corners of the boxes, the weight in `low`; the same buffer for seeds
  /// \param count      at least 1
  void enqueue(cl_mem low, cl_mem high, std::uint32_t count);

  int levels() const { return levels_; }
  std::uint32_t node_count() const { return node_count_; }
  cl::RawBuffer node_low, node_high;       ///< seed_t: corners of the boxes, the largest weight in node_low
  cl::Buffer<std::uint32_t> level_offset;  ///< levels + 1

 private:
  cl::Kernel lay_out_, build_;
  int levels_ = 0;
  std::uint32_t node_count_ = 0;
};

}  // namespace powercell
