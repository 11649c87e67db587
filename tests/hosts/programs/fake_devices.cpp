// Preloaded, it lets devices look and behave like others. FAKE_DEVICES="K.key=value;...", with K the place of
// a device among those of all platforms: type (gpu), name, vendor, units, clock, unified (0, 1), and what
// fails with a status: info (each query), build, context, queue.
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace {

template <class Function>
Function* real(const char* name) {
  static void* const loader = dlopen("libOpenCL.so.1", RTLD_NOW | RTLD_LOCAL);
  return reinterpret_cast<Function*>(dlsym(loader, name));
}
#define REAL(name) real<decltype(name)>(#name)

const std::vector<cl_device_id>& all_devices() {
  static const auto& all = *new std::vector<cl_device_id>([] {
    std::vector<cl_device_id> found;
    cl_uint count = 0;
    REAL(clGetPlatformIDs)(0, nullptr, &count);
    std::vector<cl_platform_id> platforms(count);
    REAL(clGetPlatformIDs)(count, platforms.data(), nullptr);
    for (cl_platform_id platform : platforms) {
      if (REAL(clGetDeviceIDs)(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count) != CL_SUCCESS) continue;
      const std::size_t before = found.size();
      found.resize(before + count);
      REAL(clGetDeviceIDs)(platform, CL_DEVICE_TYPE_ALL, count, &found[before], nullptr);
    }
    return found;
  }());
  return all;
}

const std::map<std::string, std::string>& wishes() {
  static const auto& all = *new std::map<std::string, std::string>([] {
    std::map<std::string, std::string> made;
    const char* set = std::getenv("FAKE_DEVICES");
    std::string text = set ? set : "";
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
      end = std::min(text.find(';', begin), text.size());
      const std::string wish = text.substr(begin, end - begin);
      made[wish.substr(0, wish.find('='))] = wish.substr(wish.find('=') + 1);
    }
    return made;
  }());
  return all;
}

const std::string* wish(cl_device_id device, const char* key) {
  for (std::size_t k = 0; k < all_devices().size(); ++k)
    if (all_devices()[k] == device)
      if (const auto found = wishes().find(std::to_string(k) + "." + key); found != wishes().end())
        return &found->second;
  return nullptr;
}

cl_int status_of(const std::string& text) {
  return std::atoi(text.c_str());
}

cl_int give(const void* from, std::size_t bytes, std::size_t room, void* value, std::size_t* size) {
  if (size) *size = bytes;
  if (value && room < bytes) return CL_INVALID_VALUE;
  if (value) std::memcpy(value, from, bytes);
  return CL_SUCCESS;
}

/// A number of the type that the property has.
template <class T>
cl_int give_number(const std::string& text, std::size_t room, void* value, std::size_t* size) {
  const T number = static_cast<T>(std::strtoull(text.c_str(), nullptr, 0));
  return give(&number, sizeof number, room, value, size);
}

}  // namespace

extern "C" {

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info property, std::size_t room, void* value,
                       std::size_t* size) {
  if (const std::string* status = wish(device, "info")) return status_of(*status);
  const std::string* text = nullptr;
  switch (property) {
    case CL_DEVICE_TYPE:
      if (wish(device, "type")) {
        const cl_device_type gpu = CL_DEVICE_TYPE_GPU;
        return give(&gpu, sizeof gpu, room, value, size);
      }
      break;
    case CL_DEVICE_NAME:
    case CL_DEVICE_VENDOR:
      text = wish(device, property == CL_DEVICE_NAME ? "name" : "vendor");
      if (text) return give(text->c_str(), text->size() + 1, room, value, size);
      break;
    case CL_DEVICE_MAX_COMPUTE_UNITS:
    case CL_DEVICE_MAX_CLOCK_FREQUENCY:
    case CL_DEVICE_HOST_UNIFIED_MEMORY:
      text = wish(device, property == CL_DEVICE_MAX_COMPUTE_UNITS     ? "units"
                          : property == CL_DEVICE_MAX_CLOCK_FREQUENCY ? "clock"
                                                                      : "unified");
      if (text) return give_number<cl_uint>(*text, room, value, size);
      break;
    default:
      break;
  }
  return REAL(clGetDeviceInfo)(device, property, room, value, size);
}

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id* devices, const char* options,
                      void (*done)(cl_program, void*), void* data) {
  if (const std::string* status = count ? wish(devices[0], "build") : nullptr) return status_of(*status);
  return REAL(clBuildProgram)(program, count, devices, options, done, data);
}

cl_context clCreateContext(const cl_context_properties* properties, cl_uint count,
                           const cl_device_id* devices,
                           void (*notify)(const char*, const void*, std::size_t, void*), void* data,
                           cl_int* status) {
  if (const std::string* failure = count ? wish(devices[0], "context") : nullptr) {
    if (status) *status = status_of(*failure);
    return nullptr;
  }
  return REAL(clCreateContext)(properties, count, devices, notify, data, status);
}

cl_command_queue clCreateCommandQueue(cl_context context, cl_device_id device,
                                      cl_command_queue_properties properties, cl_int* status) {
  if (const std::string* failure = wish(device, "queue")) {
    if (status) *status = status_of(*failure);
    return nullptr;
  }
  return REAL(clCreateCommandQueue)(context, device, properties, status);
}

}  // extern "C"
