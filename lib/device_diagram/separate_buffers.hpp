/// \file
/// Whether buffers of a caller share memory.
#pragma once

#include <span>

#include "lib/cl/opencl.hpp"

namespace powercell {

/// A buffer of a call.
struct CallersBuffer {
  cl_mem memory;     ///< may be null
  const char* name;  ///< for messages
  bool written;
};

/// \throw Error invalid_argument if memory that is written is that of another buffer too, in whole or in
/// part: one buffer twice, sub-buffers that overlap, or buffers that use the same memory of the host. Names
/// both
void require_separate(std::span<const CallersBuffer> buffers);

}  // namespace powercell
