/// \file
/// The best rates that a device reaches, measured: the yardstick of `powercell bench`.
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
/// \throw Error no_fp64; self_test_failed (a wrong result); out_of_device_memory, build_failed, opencl
POWERCELL_API DeviceRates measure_device_rates(const Device& device,
                                               Precision precision = Precision::automatic);

}  // namespace powercell
