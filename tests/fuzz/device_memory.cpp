#include "tests/fuzz/device_memory.hpp"

#include "tests/fuzz/laws.hpp"

namespace powercell::fuzz {

const Caller& caller() {
  static const Caller made = [] {
    const DeviceInfo info = shared_device().info();
    cl_platform_id platforms[16];
    cl_device_id found[16];
    succeed(clGetPlatformIDs(16, platforms, nullptr), "clGetPlatformIDs");
    succeed(clGetDeviceIDs(platforms[info.platform], CL_DEVICE_TYPE_ALL, 16, found, nullptr),
            "clGetDeviceIDs");
    Caller result;
    cl_int status = CL_SUCCESS;
    result.context = clCreateContext(nullptr, 1, &found[info.device], nullptr, nullptr, &status);
    succeed(status, "clCreateContext");
    result.queue = clCreateCommandQueue(result.context, found[info.device], 0, &status);
    succeed(status, "clCreateCommandQueue");
    return result;
  }();
  return made;
}

const Device& caller_device() {
  static const auto* made = new Device(device_from_queue(caller().queue));
  return *made;
}

Memory::Memory(std::size_t bytes, const void* values) {
  if (bytes == 0) values = nullptr;  // OpenCL has no buffers of 0 bytes
  cl_int status = CL_SUCCESS;
  handle = clCreateBuffer(caller().context, CL_MEM_READ_WRITE | (values ? CL_MEM_COPY_HOST_PTR : 0),
                          bytes > 0 ? bytes : 1, const_cast<void*>(values), &status);
  succeed(status, "clCreateBuffer");
}

}  // namespace powercell::fuzz
