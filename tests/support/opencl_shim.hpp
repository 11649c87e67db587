/// \file
/// A layer over the OpenCL entry points that the library calls: it counts calls and living objects, and makes
/// calls fail, the device get lost, memory run out or a property be another one, as a test tells it.
///
/// A test that links powercell_opencl_shim defines the entry points itself; each passes on to the ICD loader.
/// With nothing told the layer changes nothing. Safe to be called from several threads.
#pragma once

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace powercell::test::shim {

/// Every entry point of the library, and the few more that tests use.
enum class Entry : std::size_t {
  clBuildProgram,
  clCreateBuffer,
  clCreateCommandQueue,
  clCreateContext,
  clCreateKernel,
  clCreateProgramWithBinary,
  clCreateProgramWithSource,
  clCreateUserEvent,
  clEnqueueBarrierWithWaitList,
  clEnqueueFillBuffer,
  clEnqueueMapBuffer,
  clEnqueueMarkerWithWaitList,
  clEnqueueMigrateMemObjects,
  clEnqueueNDRangeKernel,
  clEnqueueReadBuffer,
  clEnqueueUnmapMemObject,
  clEnqueueWriteBuffer,
  clFinish,
  clFlush,
  clGetCommandQueueInfo,
  clGetDeviceIDs,
  clGetDeviceInfo,
  clGetEventInfo,
  clGetEventProfilingInfo,
  clGetKernelInfo,
  clGetKernelWorkGroupInfo,
  clGetMemObjectInfo,
  clGetPlatformIDs,
  clGetPlatformInfo,
  clGetProgramBuildInfo,
  clGetProgramInfo,
  clReleaseCommandQueue,
  clReleaseContext,
  clReleaseEvent,
  clReleaseKernel,
  clReleaseMemObject,
  clReleaseProgram,
  clRetainCommandQueue,
  clRetainContext,
  clSetKernelArg,
  clWaitForEvents,
  count
};
constexpr std::size_t entry_count = static_cast<std::size_t>(Entry::count);
const char* name(Entry entry);

/// Counts of all entry points since the last reset_calls().
using Calls = std::array<std::uint64_t, entry_count>;
Calls calls();
void reset_calls();

/// Objects made or retained and not yet released, as the program holds them, and buffers mapped.
struct Alive {
  int contexts = 0, queues = 0, buffers = 0, programs = 0, kernels = 0, events = 0, maps = 0;
  friend bool operator==(const Alive&, const Alive&) = default;
};
Alive alive();
std::string to_string(const Alive& alive);
/// Most bytes that buffers had at once since reset_calls().
std::size_t peak_buffer_bytes();
/// Releases of something that was not there, since the start: always an error.
int wrong_releases();

/// The nth call of `entry` from now on (from 1) fails with `code`, that one alone. A release that fails has
/// released. An enqueue that fails has enqueued nothing.
void fail(Entry entry, std::uint64_t nth, cl_int code);
/// From the nth call from now on (from 1) that needs the device, all such calls fail with `code`.
void lose_device(std::uint64_t nth, cl_int code);
/// Calls so far, since reset_calls(), that needed the device.
std::uint64_t device_calls();
/// True if what fail() or lose_device() told has happened.
bool fired();
/// Buffers that would make more than this fail with CL_MEM_OBJECT_ALLOCATION_FAILURE.
void limit_memory(std::size_t bytes);
/// What clGetDeviceInfo says of a property that is one number (of 4 or 8 bytes).
void pretend(cl_device_info property, std::uint64_t value);
/// Kernels run in groups of this many work-items, whatever the program asks for.
void force_group_size(std::size_t items);
/// Back to changing nothing; counts stay.
void behave();

/// Calls behave() at the end of a scope.
struct Scope {
  Scope() = default;
  ~Scope() { behave(); }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;
};

}  // namespace powercell::test::shim
