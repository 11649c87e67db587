// The entry points of OpenCL, each passed on to the ICD loader.
#include <algorithm>

#include "tests/support/opencl_layer.hpp"

using namespace powercell::test::shim;

namespace {

template <class Object>
Object refused(cl_int code, cl_int* status) {
  if (status) *status = code;
  return nullptr;
}

template <class Object>
Object kept(Kind kind, Object object) {
  if (object) hold(kind, object);
  return object;
}

cl_int kept_event(cl_int status, cl_event* made) {
  if (status == CL_SUCCESS && made) hold(event, *made);
  return status;
}

}  // namespace

// An entry point that returns a status.
#define PASS(function, parameters, arguments)                     \
  cl_int function parameters {                                    \
    if (const cl_int code = before(Entry::function)) return code; \
    return real<decltype(function)>(Entry::function) arguments;   \
  }
// One that returns an object, with the status in its last argument.
#define MAKE(function, type, kind, parameters, arguments)                                \
  type function parameters {                                                             \
    if (const cl_int code = before(Entry::function)) return refused<type>(code, status); \
    return kept(kind, real<decltype(function)>(Entry::function) arguments);              \
  }
// One that makes an event if the caller wants one.
#define ENQUEUE(function, parameters, arguments)                                  \
  cl_int function parameters {                                                    \
    if (const cl_int code = before(Entry::function)) return code;                 \
    return kept_event(real<decltype(function)>(Entry::function) arguments, made); \
  }
// Releases even if it must fail: only the returned status is an error.
#define RELEASE(function, type, kind)                                        \
  cl_int function(type object) {                                             \
    const cl_int code = before(Entry::function);                             \
    let_go(kind, object);                                                    \
    const cl_int status = real<decltype(function)>(Entry::function)(object); \
    return code != CL_SUCCESS ? code : status;                               \
  }
#define RETAIN(function, type, kind)                                         \
  cl_int function(type object) {                                             \
    if (const cl_int code = before(Entry::function)) return code;            \
    const cl_int status = real<decltype(function)>(Entry::function)(object); \
    if (status == CL_SUCCESS) hold(kind, object);                            \
    return status;                                                           \
  }

using Events = const cl_event*;
using Sizes = const std::size_t*;
using BuildDone = void(CL_CALLBACK*)(cl_program, void*);
using ContextError = void(CL_CALLBACK*)(const char*, const void*, std::size_t, void*);

extern "C" {

PASS(clBuildProgram,
     (cl_program p, cl_uint n, const cl_device_id* devices, const char* options, BuildDone done, void* data),
     (p, n, devices, options, done, data))
MAKE(clCreateCommandQueue, cl_command_queue, queue,
     (cl_context c, cl_device_id device, cl_command_queue_properties properties, cl_int* status),
     (c, device, properties, status))
MAKE(clCreateContext, cl_context, context,
     (const cl_context_properties* properties, cl_uint n, const cl_device_id* devices, ContextError notify,
      void* data, cl_int* status),
     (properties, n, devices, notify, data, status))
MAKE(clCreateKernel, cl_kernel, kernel, (cl_program p, const char* text, cl_int* status), (p, text, status))
MAKE(clCreateProgramWithBinary, cl_program, program,
     (cl_context c, cl_uint n, const cl_device_id* devices, Sizes lengths, const unsigned char** binaries,
      cl_int* binary_status, cl_int* status),
     (c, n, devices, lengths, binaries, binary_status, status))
MAKE(clCreateProgramWithSource, cl_program, program,
     (cl_context c, cl_uint n, const char** texts, Sizes lengths, cl_int* status),
     (c, n, texts, lengths, status))
MAKE(clCreateUserEvent, cl_event, event, (cl_context c, cl_int* status), (c, status))

cl_mem clCreateBuffer(cl_context c, cl_mem_flags flags, std::size_t bytes, void* host, cl_int* status) {
  if (const cl_int code = before(Entry::clCreateBuffer)) return refused<cl_mem>(code, status);
  if (!fits(bytes)) return refused<cl_mem>(CL_MEM_OBJECT_ALLOCATION_FAILURE, status);
  const cl_mem made = real<decltype(clCreateBuffer)>(Entry::clCreateBuffer)(c, flags, bytes, host, status);
  if (!made) return made;
  hold(buffer, made);
  const std::lock_guard lock(layer().mutex);
  layer().bytes[made] = bytes;
  layer().total_bytes += bytes;
  layer().peak_bytes = std::max(layer().peak_bytes, layer().total_bytes);
  return made;
}

ENQUEUE(clEnqueueBarrierWithWaitList, (cl_command_queue q, cl_uint n, Events wait, cl_event* made),
        (q, n, wait, made))
ENQUEUE(clEnqueueFillBuffer,
        (cl_command_queue q, cl_mem m, const void* pattern, std::size_t size, std::size_t offset,
         std::size_t bytes, cl_uint n, Events wait, cl_event* made),
        (q, m, pattern, size, offset, bytes, n, wait, made))
ENQUEUE(clEnqueueMarkerWithWaitList, (cl_command_queue q, cl_uint n, Events wait, cl_event* made),
        (q, n, wait, made))
ENQUEUE(clEnqueueMigrateMemObjects,
        (cl_command_queue q, cl_uint count, const cl_mem* m, cl_mem_migration_flags flags, cl_uint n,
         Events wait, cl_event* made),
        (q, count, m, flags, n, wait, made))
ENQUEUE(clEnqueueReadBuffer,
        (cl_command_queue q, cl_mem m, cl_bool blocking, std::size_t offset, std::size_t bytes, void* to,
         cl_uint n, Events wait, cl_event* made),
        (q, m, blocking, offset, bytes, to, n, wait, made))
ENQUEUE(clEnqueueWriteBuffer,
        (cl_command_queue q, cl_mem m, cl_bool blocking, std::size_t offset, std::size_t bytes,
         const void* from, cl_uint n, Events wait, cl_event* made),
        (q, m, blocking, offset, bytes, from, n, wait, made))

cl_int clEnqueueNDRangeKernel(cl_command_queue q, cl_kernel k, cl_uint dimensions, Sizes first, Sizes global,
                              Sizes local, cl_uint n, Events wait, cl_event* made) {
  if (const cl_int code = before(Entry::clEnqueueNDRangeKernel)) return code;
  std::size_t items = global[0], group = 0;
  {
    const std::lock_guard lock(layer().mutex);
    group = layer().group_size;
  }
  if (group > 0 && dimensions == 1) {
    items = (items + group - 1) / group * group;
    global = &items;
    local = &group;
  }
  return kept_event(real<decltype(clEnqueueNDRangeKernel)>(Entry::clEnqueueNDRangeKernel)(
                        q, k, dimensions, first, global, local, n, wait, made),
                    made);
}

void* clEnqueueMapBuffer(cl_command_queue q, cl_mem m, cl_bool blocking, cl_map_flags flags,
                         std::size_t offset, std::size_t bytes, cl_uint n, Events wait, cl_event* made,
                         cl_int* status) {
  if (const cl_int code = before(Entry::clEnqueueMapBuffer)) return refused<void*>(code, status);
  cl_int result = CL_SUCCESS;
  void* const mapped = real<decltype(clEnqueueMapBuffer)>(Entry::clEnqueueMapBuffer)(
      q, m, blocking, flags, offset, bytes, n, wait, made, &result);
  if (status) *status = result;
  kept_event(result, made);
  return result == CL_SUCCESS ? kept(map, mapped) : nullptr;
}

// Unmaps even if it must fail, like a release: otherwise the buffer could never be used again.
cl_int clEnqueueUnmapMemObject(cl_command_queue q, cl_mem m, void* mapped, cl_uint n, Events wait,
                               cl_event* made) {
  const cl_int code = before(Entry::clEnqueueUnmapMemObject);
  let_go(map, mapped);
  const cl_int status = real<decltype(clEnqueueUnmapMemObject)>(Entry::clEnqueueUnmapMemObject)(
      q, m, mapped, n, wait, code != CL_SUCCESS ? nullptr : made);
  return code != CL_SUCCESS ? code : kept_event(status, made);
}

PASS(clFinish, (cl_command_queue q), (q))
PASS(clFlush, (cl_command_queue q), (q))
PASS(clGetCommandQueueInfo,
     (cl_command_queue q, cl_command_queue_info which, std::size_t size, void* value, std::size_t* needed),
     (q, which, size, value, needed))
PASS(clGetDeviceIDs,
     (cl_platform_id p, cl_device_type type, cl_uint n, cl_device_id* devices, cl_uint* found),
     (p, type, n, devices, found))

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info which, std::size_t size, void* value,
                       std::size_t* needed) {
  if (const cl_int code = before(Entry::clGetDeviceInfo)) return code;
  const cl_int status =
      real<decltype(clGetDeviceInfo)>(Entry::clGetDeviceInfo)(device, which, size, value, needed);
  if (status == CL_SUCCESS) pretend_over(which, size, value);
  return status;
}

PASS(clGetEventInfo, (cl_event e, cl_event_info which, std::size_t size, void* value, std::size_t* needed),
     (e, which, size, value, needed))
PASS(clGetEventProfilingInfo,
     (cl_event e, cl_profiling_info which, std::size_t size, void* value, std::size_t* needed),
     (e, which, size, value, needed))
PASS(clGetKernelInfo, (cl_kernel k, cl_kernel_info which, std::size_t size, void* value, std::size_t* needed),
     (k, which, size, value, needed))
PASS(clGetKernelWorkGroupInfo,
     (cl_kernel k, cl_device_id device, cl_kernel_work_group_info which, std::size_t size, void* value,
      std::size_t* needed),
     (k, device, which, size, value, needed))
PASS(clGetMemObjectInfo, (cl_mem m, cl_mem_info which, std::size_t size, void* value, std::size_t* needed),
     (m, which, size, value, needed))
PASS(clGetPlatformIDs, (cl_uint n, cl_platform_id* platforms, cl_uint* found), (n, platforms, found))
PASS(clGetPlatformInfo,
     (cl_platform_id p, cl_platform_info which, std::size_t size, void* value, std::size_t* needed),
     (p, which, size, value, needed))
PASS(clGetProgramBuildInfo,
     (cl_program p, cl_device_id device, cl_program_build_info which, std::size_t size, void* value,
      std::size_t* needed),
     (p, device, which, size, value, needed))
PASS(clGetProgramInfo,
     (cl_program p, cl_program_info which, std::size_t size, void* value, std::size_t* needed),
     (p, which, size, value, needed))
RELEASE(clReleaseCommandQueue, cl_command_queue, queue)
RELEASE(clReleaseContext, cl_context, context)
RELEASE(clReleaseEvent, cl_event, event)
RELEASE(clReleaseKernel, cl_kernel, kernel)
RELEASE(clReleaseMemObject, cl_mem, buffer)
RELEASE(clReleaseProgram, cl_program, program)
RETAIN(clRetainCommandQueue, cl_command_queue, queue)
RETAIN(clRetainContext, cl_context, context)
RETAIN(clRetainMemObject, cl_mem, buffer)
PASS(clSetKernelArg, (cl_kernel k, cl_uint index, std::size_t size, const void* value),
     (k, index, size, value))
PASS(clWaitForEvents, (cl_uint n, Events wait), (n, wait))

}  // extern "C"
