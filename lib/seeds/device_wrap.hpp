/// \file
/// The caller's seeds wrapped into a periodic domain in device memory. Internal.
#pragma once

#include <cstdint>

#include "lib/cl/program.hpp"
#include "lib/domain/frame.hpp"
#include "lib/domain/period.hpp"

namespace powercell {

/// Wraps seeds to the positions that Period::wrap finds, bit by bit. Enqueues without waiting.
class DeviceWrap {
 public:
  /// Uploads the lattice and builds the kernel. \param defines  Variant::defines()
  DeviceWrap(const std::shared_ptr<cl::Context>& context, const std::vector<std::string>& defines,
             const Period& period, const Frame& host_frame);

  /// As DeviceSeeds::enqueue. \param packed  written: seed_t  \param status  written: SEED_OK or _INVALID
  void enqueue(cl_mem frame, cl_mem positions, cl_mem weights, std::uint32_t count, cl_mem packed,
               cl_mem status);

  cl::Buffer<std::int64_t> period;  ///< PERIOD_... of kernels/layout.h
  cl::Buffer<std::int64_t> place;   ///< by seed as given: its coordinates as integers (kernels/seeds/wrap.cl)
  /// By seed as given, 3 each: from the wrapped seed, in the vectors as given.
  cl::Buffer<std::int32_t> shift;

 private:
  std::size_t dimension_;
  cl::Kernel wrap_;
};

}  // namespace powercell
