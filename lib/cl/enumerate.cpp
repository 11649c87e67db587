#include "lib/cl/enumerate.hpp"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <string_view>

#include "lib/base/float_environment.hpp"
#include "lib/cl/errors.hpp"
#include "lib/report/log.hpp"

namespace powercell {
namespace cl {
namespace {

constexpr cl_int platform_not_found_khr = -1001;

std::string trimmed(std::string text) {
  const char* blank = " \t\r\n";
  text.resize(text.find('\0') == std::string::npos ? text.size() : text.find('\0'));
  const auto first = text.find_first_not_of(blank);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::string device_text(cl_device_id device, cl_device_info which) {
  std::size_t size = 0;
  check_query(clGetDeviceInfo(device, which, 0, nullptr, &size), "asking a device for the length of a text");
  std::string text(size, '\0');
  check_query(clGetDeviceInfo(device, which, size, text.data(), nullptr), "asking a device for a text");
  return trimmed(std::move(text));
}

template <class T>
T device_value(cl_device_id device, cl_device_info which) {
  T value{};
  check_query(clGetDeviceInfo(device, which, sizeof value, &value, nullptr),
              "asking a device for its property " + std::to_string(which));
  return value;
}

/// The environment variable if it is set.
/// \throw Error invalid_argument if it is anything but `word`
bool environment_says(const char* name, std::string_view word) {
  const char* set = std::getenv(name);
  const std::string_view value = set ? set : "";
  if (!value.empty() && value != word)
    throw Error(ErrorCode::invalid_argument, "the environment variable " + std::string(name) + " is '" +
                                                 std::string(value) + "'; '" + std::string(word) +
                                                 "' is expected");
  return !value.empty();
}

bool has_fp64(cl_device_id device) {
  if (environment_says("POWERCELL_FP64", "never")) return false;  // where the self-test refuses it
  cl_device_fp_config config = 0;
  const cl_int status = clGetDeviceInfo(device, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof config, &config, nullptr);
  // Devices of OpenCL 1.1 without the extension do not know the query: they have no double precision. Any
  // other failure is an error, else a device would silently compute in single precision.
  if (status == CL_INVALID_VALUE) return false;
  check_query(status, "asking a device for its double precision");
  return config != 0;
}

DeviceInfo::Type type_of(cl_device_id device) {
  const auto type = device_value<cl_device_type>(device, CL_DEVICE_TYPE);
  if (type & CL_DEVICE_TYPE_GPU) return DeviceInfo::Type::gpu;
  if (type & CL_DEVICE_TYPE_CPU) return DeviceInfo::Type::cpu;
  if (type & CL_DEVICE_TYPE_ACCELERATOR) return DeviceInfo::Type::accelerator;
  return DeviceInfo::Type::other;
}

std::vector<cl_platform_id> find_platforms() {
  cl_uint count = 0;
  const cl_int status = clGetPlatformIDs(0, nullptr, &count);
  if (status == platform_not_found_khr || status == status_not_found || (status == CL_SUCCESS && count == 0))
    return {};
  check_query(status, "counting the OpenCL platforms");
  std::vector<cl_platform_id> platforms(count);
  check_query(clGetPlatformIDs(count, platforms.data(), nullptr), "listing the OpenCL platforms");
  return platforms;
}

std::vector<cl_device_id> devices_of(cl_platform_id platform) {
  cl_uint count = 0;
  const cl_int status = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count);
  if (status == CL_DEVICE_NOT_FOUND || (status == CL_SUCCESS && count == 0)) return {};
  check_query(status, "listing its devices");
  std::vector<cl_device_id> devices(count);
  check_query(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, devices.data(), nullptr),
              "listing its devices");
  return devices;
}

/// Runs `query`.
/// \return what it says where OpenCL cannot answer; empty where it can
template <class Query>
std::string fault_of(const Query& query) {
  try {
    query();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::opencl) throw;
    return error.what();
  }
  return {};
}

/// The platform's name, if it can say it.
std::string name_of(cl_platform_id platform) {
  std::string text;
  fault_of([&] { text = platform_text(platform, CL_PLATFORM_NAME); });
  return text.empty() ? "a platform without a name" : text;
}

std::string name_of(cl_device_id device) {
  std::string text;
  fault_of([&] { text = device_text(device, CL_DEVICE_NAME); });
  return text.empty() ? "a device without a name" : text;
}

/// Why the device cannot be used whatever is asked of it; empty if it can.
std::string refusal_of(cl_device_id device) {
  if (!device_value<cl_bool>(device, CL_DEVICE_AVAILABLE)) return "it says that it is not available";
  if (!device_value<cl_bool>(device, CL_DEVICE_COMPILER_AVAILABLE)) return "it has no compiler";
  return {};
}

void set_aside(FoundDevices& found, UnusableDevice unusable) {
  write_log(LogLevel::info, [&] { return describe(unusable) + " is set aside: " + unusable.reason; });
  found.unusable.push_back(std::move(unusable));
}

}  // namespace

std::string platform_text(cl_platform_id platform, cl_platform_info which) {
  std::size_t size = 0;
  check_query(clGetPlatformInfo(platform, which, 0, nullptr, &size),
              "asking a platform for the length of a text");
  std::string text(size, '\0');
  check_query(clGetPlatformInfo(platform, which, size, text.data(), nullptr), "asking a platform for a text");
  return trimmed(std::move(text));
}

DeviceInfo describe(cl_platform_id platform, cl_device_id device) {
  DeviceInfo info;
  info.platform_name = platform_text(platform, CL_PLATFORM_NAME);
  info.name = device_text(device, CL_DEVICE_NAME);
  info.vendor = device_text(device, CL_DEVICE_VENDOR);
  info.driver_version = device_text(device, CL_DRIVER_VERSION);
  info.opencl_c_version = device_text(device, CL_DEVICE_OPENCL_C_VERSION);
  // For tests of what only GPUs are given: chunks, lanes, groups and overlap.
  info.type = environment_says("POWERCELL_TREAT_AS", "gpu") ? DeviceInfo::Type::gpu : type_of(device);
  info.fp64 = has_fp64(device);
  info.compute_units = device_value<cl_uint>(device, CL_DEVICE_MAX_COMPUTE_UNITS);
  info.unified_memory = device_value<cl_bool>(device, CL_DEVICE_HOST_UNIFIED_MEMORY) == CL_TRUE;
  info.clock_mhz = device_value<cl_uint>(device, CL_DEVICE_MAX_CLOCK_FREQUENCY);
  info.memory_bytes = device_value<cl_ulong>(device, CL_DEVICE_GLOBAL_MEM_SIZE);
  info.largest_allocation = device_value<cl_ulong>(device, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
  info.max_work_group_size = device_value<std::size_t>(device, CL_DEVICE_MAX_WORK_GROUP_SIZE);
  return info;
}

std::string describe(const UnusableDevice& unusable) {
  const std::string place = std::to_string(unusable.platform);
  if (unusable.device < 0) return "the platform " + place + " " + unusable.name;
  return "the device " + place + ":" + std::to_string(unusable.device) + " " + unusable.name;
}

std::string reasons(std::span<const UnusableDevice> unusable) {
  std::string text;
  for (const UnusableDevice& one : unusable) text += "; " + describe(one) + ": " + one.reason;
  return text;
}

std::string no_device_message(std::span<const UnusableDevice> unusable) {
  const std::string advice =
      "install a driver, for example one that runs on any CPU: apt-get install pocl-opencl-icd";
  if (const std::string fault = loader_fault(); !fault.empty())
    return "no OpenCL on this machine (" + fault + "); " + advice;
  for (cl_platform_id platform : find_platforms())
    // PoCL has none if it cannot make the folder of its cache.
    if (name_of(platform) == "Portable Computing Language" && devices_of(platform).empty())
      return "PoCL is installed but has no device: it probably cannot write its cache, as without a home "
             "folder; set "
             "POCL_CACHE_DIR to a folder that can be written";
  if (unusable.empty()) return "no OpenCL device on this machine; " + advice;
  return "no OpenCL device on this machine can be used" + reasons(unusable) + "; mend its driver, or " +
         advice;
}

FoundDevices find_devices() {
  require_not_forked();  // before a lock that a thread of the parent may hold
  // PoCL sets itself up at the first query: another thread found no device there, or crashed (PoCL 3.1).
  static std::mutex one_at_a_time;
  const std::scoped_lock lock(one_at_a_time);
  FoundDevices found;
  const auto platforms = find_platforms();
  for (std::size_t p = 0; p < platforms.size(); ++p) {
    const int platform = static_cast<int>(p);
    std::vector<cl_device_id> devices;
    if (std::string fault = fault_of([&] { devices = devices_of(platforms[p]); }); !fault.empty())
      set_aside(found, {platform, -1, name_of(platforms[p]), std::move(fault)});
    for (std::size_t d = 0; d < devices.size(); ++d) {
      FoundDevice entry{platforms[p], devices[d], {}};
      std::string refusal;
      std::string fault = fault_of([&] {
        refusal = refusal_of(devices[d]);
        if (refusal.empty()) entry.info = describe(platforms[p], devices[d]);
      });
      entry.info.platform = platform;
      entry.info.device = static_cast<int>(d);
      if (fault.empty() && refusal.empty())
        found.usable.push_back(std::move(entry));
      else
        set_aside(found, {platform, entry.info.device, name_of(devices[d]), fault.empty() ? refusal : fault});
    }
  }
  return found;
}

void find_indices(cl_platform_id platform, cl_device_id device, DeviceInfo& info) {
  const auto platforms = find_platforms();
  const auto devices = devices_of(platform);
  info.platform =
      static_cast<int>(std::find(platforms.begin(), platforms.end(), platform) - platforms.begin());
  info.device = static_cast<int>(std::find(devices.begin(), devices.end(), device) - devices.begin());
}

}  // namespace cl

const char* name(DeviceInfo::Type type) noexcept {
  switch (type) {
    case DeviceInfo::Type::cpu:
      return "cpu";
    case DeviceInfo::Type::gpu:
      return "gpu";
    case DeviceInfo::Type::accelerator:
      return "accelerator";
    case DeviceInfo::Type::other:
      break;
  }
  return "other";
}

std::vector<DeviceInfo> devices() {
  const FloatEnvironment environment;
  std::vector<DeviceInfo> infos;
  for (auto& found : cl::find_devices().usable) infos.push_back(std::move(found.info));
  return infos;
}

std::vector<UnusableDevice> unusable_devices() {
  const FloatEnvironment environment;
  return cl::find_devices().unusable;
}

}  // namespace powercell
