/// \file
/// The best rates and latencies that a device reaches, measured: the yardstick of `powercell bench`.
#pragma once

#include <cstddef>
#include <powercell/device.hpp>
#include <powercell/options.hpp>

namespace powercell {

/// Rates of two small kernels, each the best of several launches. The scatter of a figure, here and below: by
/// how much longer than the best run their lower quartile took, relative to the best.
struct DeviceRates {
  double copied_bytes = 0;  ///< bytes read plus bytes written per second while copying a large buffer
  double operations = 0;    ///< multiplications plus additions per second; a fused one counts as two
  double copied_scatter = 0, operations_scatter = 0;
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
  double launch_scatter = 0, transfer_scatter = 0;
};

/// Takes a few milliseconds, and once the time to compile a kernel.
/// \throw Error self_test_failed (a wrong result); unsupported (a group); build_failed, opencl
POWERCELL_API DeviceLatencies measure_device_latencies(const Device& device);

/// Bytes a second from one memory to the other, measured on the host from the call to its end, each the best
/// of several: of few bytes what a call costs, of many what the way between the memories carries.
struct DeviceTransfers {
  double to_device = 0;  ///< from ordinary host memory, which the caller may change afterwards
  double to_host = 0;
  double to_device_scatter = 0, to_host_scatter = 0;
};

/// Takes a fifth of a second, or nine transfers each way if these take longer, `bytes` of device memory and
/// twice as much of the host's. What comes back is compared with what was sent. 	hrow Error
/// invalid_argument (0 bytes); self_test_failed (other bytes came back); unsupported (a group);
/// out_of_device_memory, opencl
POWERCELL_API DeviceTransfers measure_device_transfers(const Device& device, std::size_t bytes);

}  // namespace powercell
