/// \file
/// The best rates and latencies that a device reaches, measured: the yardstick of `powercell bench`.
#pragma once

#include <powercell/device.hpp>
#include <powercell/options.hpp>

namespace powercell {

/// Rates of two small kernels, each the best of several launches.
struct DeviceRates {
  double copied_bytes = 0;  ///< bytes read plus bytes written per second while copying a large buffer
  double operations = 0;    ///< multiplications plus additions per second; a fused one counts as two
};

/// Takes about a second and up to 512 MiB of device memory. Every result is checked.
/// \param precision  float64, float32, or automatic: double where the device has it
/// \throw Error no_fp64; unsupported (a group); self_test_failed (a wrong result); out_of_device_memory,
/// build_failed, opencl
POWERCELL_API DeviceRates measure_device_rates(const Device& device,
                                               Precision precision = Precision::automatic);

/// Seconds on the host from a call to its end, each the least of many: what work costs however small it is.
struct DeviceLatencies {
  double launch = 0;    ///< enqueuing a kernel of one work-item and waiting for it
  double transfer = 0;  ///< reading one number from device memory
};

/// Takes a few milliseconds, and once the time to compile a kernel. \throw Error self_test_failed (a wrong
/// result); unsupported (a group); build_failed, opencl
POWERCELL_API DeviceLatencies measure_device_latencies(const Device& device);

}  // namespace powercell
