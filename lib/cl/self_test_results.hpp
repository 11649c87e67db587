/// \file
/// What the kernels of kernels/base/self_test.cl must give, computed on the host. Internal.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace powercell::cl {

constexpr std::uint32_t self_test_items = 67;  // more than a group, and not a multiple of one

/// 3 per item: a, b, c. T is float or double.
template <class T>
std::vector<T> arithmetic_operands();
/// What is wrong with the 6 results per item of the kernel `arithmetic_...`; empty if nothing is.
template <class T>
std::string arithmetic_fault(std::span<const T> operands, std::span<const T> results);

/// 8 per item.
std::vector<std::uint32_t> control_keys();
/// What is wrong with the 10 results per item and the counter of the kernel `control`; empty if nothing is.
std::string control_fault(std::span<const std::uint32_t> keys, std::span<const std::uint32_t> results,
                          std::uint32_t odd);

}  // namespace powercell::cl
