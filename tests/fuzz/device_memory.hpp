/// \file
/// Memory of the caller on the device that the targets share.
#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <cstdint>
#include <powercell/opencl.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace powercell::fuzz {

/// \throw std::runtime_error  where a call of the target itself fails, which is no finding
inline void succeed(cl_int status, const char* what) {
  if (status != CL_SUCCESS) throw std::runtime_error(std::string(what) + ": " + std::to_string(status));
}

/// A context and queue of the caller, never freed.
struct Caller {
  cl_context context = nullptr;
  cl_command_queue queue = nullptr;
};
const Caller& caller();

/// The device of that queue, never freed.
const Device& caller_device();

/// A buffer of at least one byte that is released, with these values if any.
struct Memory {
  explicit Memory(std::size_t bytes, const void* values = nullptr);
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { clReleaseMemObject(handle); }
  cl_mem handle = nullptr;
};

/// Positions and weights of seeds.
struct DeviceSeeds {
  Memory positions, weights;
  std::uint32_t count;
};

template <class T>
std::vector<T> read(const Memory& memory, std::size_t count) {
  std::vector<T> values(count);
  if (count > 0)
    succeed(clEnqueueReadBuffer(caller().queue, memory.handle, CL_TRUE, 0, count * sizeof(T), values.data(),
                                0, nullptr, nullptr),
            "reading results");
  return values;
}

}  // namespace powercell::fuzz
