#include "tests/support/opencl_layer.hpp"

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace powercell::test::shim {
namespace {

constexpr const char* names[entry_count] = {"clBuildProgram",
                                            "clCreateBuffer",
                                            "clCreateCommandQueue",
                                            "clCreateContext",
                                            "clCreateKernel",
                                            "clCreateProgramWithBinary",
                                            "clCreateProgramWithSource",
                                            "clCreateUserEvent",
                                            "clEnqueueBarrierWithWaitList",
                                            "clEnqueueFillBuffer",
                                            "clEnqueueMapBuffer",
                                            "clEnqueueMarkerWithWaitList",
                                            "clEnqueueMigrateMemObjects",
                                            "clEnqueueNDRangeKernel",
                                            "clEnqueueReadBuffer",
                                            "clEnqueueUnmapMemObject",
                                            "clEnqueueWriteBuffer",
                                            "clFinish",
                                            "clFlush",
                                            "clGetCommandQueueInfo",
                                            "clGetDeviceIDs",
                                            "clGetDeviceInfo",
                                            "clGetEventInfo",
                                            "clGetEventProfilingInfo",
                                            "clGetKernelInfo",
                                            "clGetKernelWorkGroupInfo",
                                            "clGetMemObjectInfo",
                                            "clGetPlatformIDs",
                                            "clGetPlatformInfo",
                                            "clGetProgramBuildInfo",
                                            "clGetProgramInfo",
                                            "clReleaseCommandQueue",
                                            "clReleaseContext",
                                            "clReleaseEvent",
                                            "clReleaseKernel",
                                            "clReleaseMemObject",
                                            "clReleaseProgram",
                                            "clRetainCommandQueue",
                                            "clRetainContext",
                                            "clRetainMemObject",
                                            "clSetKernelArg",
                                            "clWaitForEvents"};

/// Whether an entry point needs the device, and fails if it is lost.
bool needs_device(Entry entry) {
  const char* text = name(entry);
  return std::strncmp(text, "clEnqueue", 9) == 0 || entry == Entry::clCreateBuffer ||
         entry == Entry::clBuildProgram || entry == Entry::clFinish || entry == Entry::clFlush ||
         entry == Entry::clWaitForEvents;
}

}  // namespace

const char* name(Entry entry) {
  return names[static_cast<std::size_t>(entry)];
}

Layer& layer() {
  static auto* the = new Layer;  // outlives every static object that holds a device
  return *the;
}

void* loader_entry(Entry entry) {
  Layer& l = layer();
  const std::lock_guard lock(l.mutex);
  if (!l.loader) l.loader = dlopen("libOpenCL.so.1", RTLD_NOW);
  void*& found = l.real[static_cast<std::size_t>(entry)];
  if (!found && l.loader) found = dlsym(l.loader, name(entry));
  if (!found) {
    std::fprintf(stderr, "the OpenCL loader has no %s\n", name(entry));
    std::abort();
  }
  return found;
}

cl_int before(Entry entry) {
  Layer& l = layer();
  const std::lock_guard lock(l.mutex);
  ++l.calls[static_cast<std::size_t>(entry)];
  if (needs_device(entry)) {
    // How often a released object must be waited for depends on the speed of the device.
    const bool counts = entry != Entry::clWaitForEvents;
    if (counts) ++l.device_calls;
    if (counts && l.lose_in > 0 && --l.lose_in == 0) l.lost = l.fired = true;
    if (l.lost) return l.code;
  }
  if (entry != l.failing || l.fail_in == 0 || --l.fail_in > 0) return CL_SUCCESS;
  l.fired = true;
  return l.code;
}

void hold(Kind kind, void* object) {
  Layer& l = layer();
  const std::lock_guard lock(l.mutex);
  ++l.held[kind][object];
}

void let_go(Kind kind, void* object) {
  Layer& l = layer();
  const std::lock_guard lock(l.mutex);
  const auto found = l.held[kind].find(object);
  if (found == l.held[kind].end()) {
    ++l.wrong_releases;
    return;
  }
  if (--found->second > 0) return;
  l.held[kind].erase(found);
  if (kind != buffer) return;
  l.total_bytes -= l.bytes[object];
  l.bytes.erase(object);
}

bool fits(std::size_t bytes) {
  Layer& l = layer();
  const std::lock_guard lock(l.mutex);
  return bytes <= l.memory_limit && l.total_bytes <= l.memory_limit - bytes;
}

void pretend_over(cl_device_info property, std::size_t size, void* value) {
  Layer& l = layer();
  const std::lock_guard lock(l.mutex);
  const auto found = l.pretended.find(property);
  if (found == l.pretended.end() || !value) return;
  const auto narrow = static_cast<std::uint32_t>(found->second);
  if (size == sizeof(std::uint64_t)) std::memcpy(value, &found->second, sizeof found->second);
  if (size == sizeof narrow) std::memcpy(value, &narrow, sizeof narrow);
}

}  // namespace powercell::test::shim
