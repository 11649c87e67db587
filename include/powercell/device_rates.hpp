/// \file
/// What a device reaches at best, measured: the yardstick of `powercell bench`.
#pragma once

#include <powercell/device.hpp>
#include <powercell/options.hpp>

namespace powercell {

/// Rates of two small kernels that do nothing else, each the best of several launches.
struct DeviceRates {
  double copied_bytes = 0;  ///< bytes read plus bytes written in a second, copying a large buffer
  double operations = 0;    ///< multiplications plus additions in a second; one fused counts as two
};

/// Measures them, in about a second; uses up to 512 MiB of device memory. Every result is checked.
/// \param precision  float64, float32, or automatic: double where the device has it
/// \throw Error no_fp64; self_test_failed (a wrong result); out_of_device_memory, build_failed, opencl
POWERCELL_API DeviceRates measure_device_rates(const Device& device,
                                               Precision precision = Precision::automatic);

}  // namespace powercell
