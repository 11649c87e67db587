/// \file
/// A layer over the OpenCL entry points that the library calls. It counts calls and objects, and on request
/// makes calls fail, loses the device, limits memory or changes a property.
///
/// powercell_opencl_shim defines the entry points in a test; each calls that of the ICD loader. Without
/// requests it changes nothing. Thread-safe.
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

/// The entry points used by the library and tests.
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
  clRetainMemObject,
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

/// Numbers of objects made or retained and not yet released, and of mapped buffers.
struct Alive {
  int contexts = 0, queues = 0, buffers = 0, programs = 0, kernels = 0, events = 0, maps = 0;
  friend bool operator==(const Alive&, const Alive&) = default;
};
Alive alive();
std::string to_string(const Alive& alive);
/// The largest total size of buffers since reset_calls().
std::size_t peak_buffer_bytes();
/// The number of releases of unknown objects since the start, each of which is an error.
int wrong_releases();

/// Makes the nth call of `entry` from now on (from 1) fail with `code`, and no other. A failed release still
/// releases; a failed enqueue enqueues nothing.
void fail(Entry entry, std::uint64_t nth, cl_int code);
/// Makes the nth call from now on (from 1) that needs the device, and all later ones, fail with `code`.
void lose_device(std::uint64_t nth, cl_int code);
/// The number of calls since reset_calls() that needed the device.
std::uint64_t device_calls();
/// Whether the fault requested by fail() or lose_device() has happened.
bool fired();
/// Makes buffers beyond a total of this size fail with CL_MEM_OBJECT_ALLOCATION_FAILURE.
void limit_memory(std::size_t bytes);
/// Changes what clGetDeviceInfo returns for a property that is one number (of 4 or 8 bytes).
void pretend(cl_device_info property, std::uint64_t value);
/// Makes kernels run in groups of this many work-items.
void force_group_size(std::size_t items);
/// Withdraws all requests; counts stay.
void behave();

/// Calls behave() at the end of a scope.
struct Scope {
  Scope() = default;
  ~Scope() { behave(); }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;
};

}  // namespace powercell::test::shim
