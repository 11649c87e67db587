/// \file
/// OpenCL devices: what there is, and the one a diagram runs on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <powercell/error.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace powercell {

namespace cl {
class Context;
}

/// One OpenCL device as enumerated on this machine.
struct DeviceInfo {
  enum class Type { cpu, gpu, accelerator, other };
  int platform = 0;  ///< index of the platform, in the order of the ICD loader
  int device = 0;    ///< index of the device within its platform
  std::string platform_name;
  std::string name;
  std::string vendor;
  std::string driver_version;
  std::string opencl_c_version;
  Type type = Type::other;
  bool fp64 = false;  ///< has double precision in kernels
  unsigned compute_units = 0;
  unsigned clock_mhz = 0;
  std::uint64_t memory_bytes = 0;        ///< global memory
  std::uint64_t largest_allocation = 0;  ///< largest single buffer, bytes
  std::size_t max_work_group_size = 0;

  /// "P:D", what `Device::choose` and `--device` accept.
  std::string selector() const { return std::to_string(platform) + ":" + std::to_string(device); }
};

/// All devices of all platforms, in enumeration order. Empty when there is no platform.
/// \throw Error opencl if a platform cannot be queried.
POWERCELL_API std::vector<DeviceInfo> devices();

/// A device with its context, queue and program cache. Copies share one state; the last one frees it.
/// Thread-safe to share between diagrams.
class POWERCELL_API Device {
 public:
  /// The device that `selector` names: "P:D" by index, or a case-insensitive part of the device's or
  /// platform's name, or "cpu" / "gpu". An empty selector asks the environment variable
  /// POWERCELL_DEVICE, then takes the GPU with the most compute units, then a CPU.
  /// The device has passed a self-test (a tiny diagram with a known answer) when this returns.
  /// \throw Error device_not_found, self_test_failed, build_failed, opencl
  static Device choose(std::string_view selector = {});

  const DeviceInfo& info() const;
  /// Seconds spent compiling kernels so far (0 when all came from a cache).
  double build_seconds() const;

  explicit Device(std::shared_ptr<cl::Context> context) : context_(std::move(context)) {}
  /// For the library's own use.
  const std::shared_ptr<cl::Context>& context() const { return context_; }

 private:
  std::shared_ptr<cl::Context> context_;
};

}  // namespace powercell
