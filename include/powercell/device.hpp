/// \file
/// OpenCL devices: the list of them, and the one or several that a diagram runs on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <powercell/error.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace powercell {

namespace cl {
class Context;
}

/// An OpenCL device of this machine.
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
  bool unified_memory = false;  ///< its memory is the host's, as that of CPUs and integrated GPUs is

  /// "P:D", as `Device::choose` and `--device` accept it.
  std::string selector() const { return std::to_string(platform) + ":" + std::to_string(device); }
};

/// "cpu", "gpu", "accelerator" or "other".
POWERCELL_API const char* name(DeviceInfo::Type type) noexcept;

/// All devices of all platforms, in the order of the ICD loader. Empty without a platform or an OpenCL
/// loader. Those that cannot be used are left out (unusable_devices), with a line in the log.
/// \throw Error opencl if the platforms cannot be listed; unsupported in a process that was forked after
/// OpenCL was used.
POWERCELL_API std::vector<DeviceInfo> devices();

/// A device that OpenCL lists and that cannot be used, or a platform that cannot list its devices.
struct UnusableDevice {
  int platform = 0;
  int device = -1;     ///< index within the platform; -1: the whole platform
  std::string name;    ///< of the device or platform
  std::string reason;  ///< one line
};

/// What devices() leaves out.
/// \throw Error as devices()
POWERCELL_API std::vector<UnusableDevice> unusable_devices();

/// Compilation of kernels in this process, on all devices and in all threads.
struct KernelBuilds {
  bool running = false;          ///< whether a kernel is being compiled now
  double seconds = 0;            ///< wall-clock time spent so far
  double processor_seconds = 0;  ///< of this process meanwhile
};
POWERCELL_API KernelBuilds kernel_builds() noexcept;

/// A device with its context, queue and program cache, or a group of several, which share the work of each
/// diagram. Copies share one state; the last one frees it. Diagrams in different threads may share a device.
class POWERCELL_API Device {
 public:
  /// Opens the device that `selector` names: "P:D" by index, a case-insensitive part of the device's or
  /// platform's name, or "cpu" / "gpu". An empty selector stands for the environment variable
  /// POWERCELL_DEVICE; without it, for the best device. GPUs are better than CPUs, GPUs with memory of their
  /// own than those that share the host's, and then those of more lanes times clock. Several selectors with
  /// commas between name a group of them, and "all" one of all devices, the best first. A device is returned
  /// only if it passes a self-test (primitives with known results). Without a wish, and for "gpu", "cpu" and
  /// "all", a device that fails is set aside, with a line in the log, and the next one is taken; a device
  /// that is named is refused with the reason.
  /// \throw Error device_not_found, self_test_failed, build_failed, out_of_device_memory, opencl;
  /// invalid_argument (a device that is named twice); unsupported (a process that was forked after OpenCL
  /// was used)
  static Device choose(std::string_view selector = {});

  /// Several devices as one. A diagram shares the clipping of its cells out to all of them by their speeds,
  /// and does what is not shared on the first. A device that was opened twice counts as two.
  /// \param devices  may be groups themselves
  /// \throw Error invalid_argument (no device, or copies of one)
  static Device group(std::span<const Device> devices);
  /// The devices of a group, in their order; of a single device itself.
  std::vector<Device> members() const;

  const DeviceInfo& info() const;  ///< of a group, that of the first
  /// Seconds spent on compiling kernels since the device was opened; 0 if all came from the cache. The sum of
  /// a group.
  double build_seconds() const;

  explicit Device(std::shared_ptr<cl::Context> context) : context_(std::move(context)) {}
  /// For the library's own use: of a group, that of the first.
  const std::shared_ptr<cl::Context>& context() const { return context_; }

 private:
  std::shared_ptr<cl::Context> context_;
  std::vector<std::shared_ptr<cl::Context>> others_;  // of a group, after the first
};

}  // namespace powercell
