/// \file
/// The state of the layer over OpenCL (opencl_shim.hpp), and the bookkeeping of its entry points.
#pragma once

#include <limits>
#include <map>
#include <mutex>

#include "tests/support/opencl_shim.hpp"

namespace powercell::test::shim {

enum Kind { context, queue, buffer, program, kernel, event, map, kinds };

struct Layer {
  std::mutex mutex;
  void* loader = nullptr;
  std::array<void*, entry_count> real{};

  Calls calls{};
  std::uint64_t device_calls = 0;
  std::array<std::map<void*, int>, kinds> held;  // references of the program
  std::map<void*, std::size_t> bytes;            // of buffers
  std::size_t total_bytes = 0, peak_bytes = 0;
  int wrong_releases = 0;

  Entry failing = Entry::count;
  std::uint64_t fail_in = 0, lose_in = 0;  // calls until it happens; 0: never
  bool lost = false, fired = false;
  cl_int code = CL_SUCCESS;
  std::size_t memory_limit = std::numeric_limits<std::size_t>::max(), group_size = 0;
  std::map<cl_device_info, std::uint64_t> pretended;
};

Layer& layer();

/// The entry point of the ICD loader. Ends the process if there is none.
void* loader_entry(Entry entry);
template <class Function>
Function* real(Entry entry) {
  return reinterpret_cast<Function*>(loader_entry(entry));
}

/// Counts a call. Returns the code with which it must fail, or CL_SUCCESS.
cl_int before(Entry entry);
void hold(Kind kind, void* object);
void let_go(Kind kind, void* object);
/// Whether a buffer of this size fits within the memory limit.
bool fits(std::size_t bytes);
/// Overwrites the driver's value with the pretended one, if any.
void pretend_over(cl_device_info property, std::size_t size, void* value);

}  // namespace powercell::test::shim
