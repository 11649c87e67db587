// usage: host_own_queue: a host with a context of its own on PoCL, whatever other platforms do.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <cstdio>
#include <cstring>
#include <powercell/opencl.hpp>

int main() try {
  cl_uint count = 0;
  clGetPlatformIDs(0, nullptr, &count);
  std::vector<cl_platform_id> platforms(count);
  clGetPlatformIDs(count, platforms.data(), nullptr);
  for (cl_platform_id platform : platforms) {
    char name[100] = "";
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof name, name, nullptr);
    if (std::strcmp(name, "Portable Computing Language") != 0) continue;
    cl_device_id device = nullptr;
    clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr);
    cl_context context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, nullptr);
    cl_command_queue queue = clCreateCommandQueue(context, device, 0, nullptr);
    const powercell::Device own = powercell::device_from_queue(queue);
    std::printf("used %s %s\n", own.info().selector().c_str(), own.info().name.c_str());
    return powercell::opencl_function("clFinish") && !powercell::opencl_function("clNoSuchFunction") ? 0 : 3;
  }
  return 4;
} catch (const powercell::Error& error) {
  std::printf("%s: %s\n", powercell::name(error.code()), error.what());
  return 2;
}
