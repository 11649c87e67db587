/// \file
/// Tests whether a device computes as OpenCL specifies.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/cl/context.hpp"

namespace powercell::cl {

/// Runs small computations with known results, in float and, where the device has it, in double.
/// \throw Error self_test_failed naming the device and the wrong result
void self_test(const std::shared_ptr<Context>& context);

constexpr std::uint32_t self_test_items = 67;    // more than a group, and not a multiple of one
constexpr std::uint32_t arithmetic_results = 7;  // of an item

/// 3 per item: a, b, c. T is float or double.
template <class T>
std::vector<T> arithmetic_operands();
/// Describes the first fault in the results of the kernel `arithmetic_...`; empty if all are right. Of
/// quotients and roots, accuracy.hpp knows how much they may be off.
template <class T>
std::string arithmetic_fault(std::span<const T> operands, std::span<const T> results);

/// 8 per item.
std::vector<std::uint32_t> control_keys();
/// Describes the first fault in the 10 results per item and the counter of the kernel `control`; empty if all
/// are right.
std::string control_fault(std::span<const std::uint32_t> keys, std::span<const std::uint32_t> results,
                          std::uint32_t odd);

}  // namespace powercell::cl
