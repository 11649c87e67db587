/// \file
/// The functions of OpenCL that the library calls. Each is looked up at its first call, so that programs
/// start on machines without an OpenCL loader, and nothing links one. Here and in all of powercell::cl a name
/// such as clFinish is the object below, which hides the function that <CL/cl.h> declares.
#pragma once

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>

#include <atomic>
#include <string>
#include <tuple>
#include <type_traits>

namespace powercell::cl {

// Statuses of our own, far from those of OpenCL and its extensions.
constexpr cl_int status_forked = -99001;     ///< the process was forked after OpenCL was used
constexpr cl_int status_not_found = -99002;  ///< there is no loader, or it lacks the function

/// The function in the process, else in the system's OpenCL loader, which stays open; null if there is none.
void* find_function(const char* name);
/// Why there is no loader; empty if there is one. For messages.
std::string loader_fault();
/// Whether the process was forked from one that had looked up a function. Its driver then lacks the threads
/// of the parent's, and most calls would wait for them for ever.
bool is_forked();

template <class>
class Function;

/// Calls an entry point of OpenCL. Where it cannot, returns a status of ours, or a null handle with that
/// status in the last argument, as OpenCL does.
template <class Result, class... Arguments>
class Function<Result CL_API_CALL(Arguments...)> {
 public:
  constexpr explicit Function(const char* name) : name_(name) {}

  Result operator()(Arguments... arguments) {
    if (is_forked()) return refused(status_forked, arguments...);
    void* entry = entry_.load(std::memory_order_acquire);
    if (!entry) entry_.store(entry = find_function(name_), std::memory_order_release);
    if (!entry) return refused(status_not_found, arguments...);
    return reinterpret_cast<Result(CL_API_CALL*)(Arguments...)>(entry)(arguments...);
  }

 private:
  static Result refused(cl_int status, Arguments... arguments) {
    if constexpr (std::is_same_v<Result, cl_int>) {
      return status;
    } else {
      cl_int* const out = std::get<sizeof...(Arguments) - 1>(std::tuple(arguments...));
      if (out) *out = status;
      return nullptr;
    }
  }

  const char* name_;
  std::atomic<void*> entry_{nullptr};
};

#define POWERCELL_OPENCL(name) inline constinit Function<decltype(::name)> name(#name);
POWERCELL_OPENCL(clBuildProgram)
POWERCELL_OPENCL(clCreateBuffer)
POWERCELL_OPENCL(clCreateCommandQueue)
POWERCELL_OPENCL(clCreateContext)
POWERCELL_OPENCL(clCreateKernel)
POWERCELL_OPENCL(clCreateProgramWithBinary)
POWERCELL_OPENCL(clCreateProgramWithSource)
POWERCELL_OPENCL(clEnqueueBarrierWithWaitList)
POWERCELL_OPENCL(clEnqueueFillBuffer)
POWERCELL_OPENCL(clEnqueueMapBuffer)
POWERCELL_OPENCL(clEnqueueMarkerWithWaitList)
POWERCELL_OPENCL(clEnqueueMigrateMemObjects)
POWERCELL_OPENCL(clEnqueueNDRangeKernel)
POWERCELL_OPENCL(clEnqueueReadBuffer)
POWERCELL_OPENCL(clEnqueueUnmapMemObject)
POWERCELL_OPENCL(clEnqueueWriteBuffer)
POWERCELL_OPENCL(clFinish)
POWERCELL_OPENCL(clFlush)
POWERCELL_OPENCL(clGetCommandQueueInfo)
POWERCELL_OPENCL(clGetDeviceIDs)
POWERCELL_OPENCL(clGetDeviceInfo)
POWERCELL_OPENCL(clGetEventInfo)
POWERCELL_OPENCL(clGetEventProfilingInfo)
POWERCELL_OPENCL(clGetKernelInfo)
POWERCELL_OPENCL(clGetKernelWorkGroupInfo)
POWERCELL_OPENCL(clGetMemObjectInfo)
POWERCELL_OPENCL(clGetPlatformIDs)
POWERCELL_OPENCL(clGetPlatformInfo)
POWERCELL_OPENCL(clGetProgramBuildInfo)
POWERCELL_OPENCL(clGetProgramInfo)
POWERCELL_OPENCL(clReleaseCommandQueue)
POWERCELL_OPENCL(clReleaseContext)
POWERCELL_OPENCL(clReleaseEvent)
POWERCELL_OPENCL(clReleaseKernel)
POWERCELL_OPENCL(clReleaseMemObject)
POWERCELL_OPENCL(clReleaseProgram)
POWERCELL_OPENCL(clRetainCommandQueue)
POWERCELL_OPENCL(clRetainContext)
POWERCELL_OPENCL(clRetainMemObject)
POWERCELL_OPENCL(clSetKernelArg)
POWERCELL_OPENCL(clWaitForEvents)
#undef POWERCELL_OPENCL

}  // namespace powercell::cl
