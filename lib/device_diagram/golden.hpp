/// \file
/// The golden diagram (lib/clip/golden.hpp) in device memory, to detect drivers that miscompile the programs
/// of a DeviceDiagram.
#pragma once

#include <powercell/device.hpp>

#include "lib/scene/variant.hpp"

namespace powercell {

/// The clip programs of a DeviceDiagram, without and with a density.
inline constexpr const char* device_clip_file = "device_diagram/clip_pairs.cl";
inline constexpr const char* device_density_file = "device_diagram/clip_density.cl";

/// Computes the golden diagram with the program of one capacity.
/// \param capacity  of the variant: its number in capacities()
/// \throw Error self_test_failed
void require_golden_measures(const Device& device, const Variant& variant, std::size_t capacity);
/// The same with a density, for the other program.
/// \pre variant.dimension is 3
void require_golden_masses(const Device& device, const Variant& variant, std::size_t capacity);

}  // namespace powercell
