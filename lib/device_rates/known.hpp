/// \file
/// The known results of kernels/device_rates/device_rates.cl.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace powercell {

/// The largest number of rounds for which the sums of the chains are exact in single precision.
constexpr std::uint32_t most_chain_rounds = 1u << 17;

/// Small integers, different for neighbouring elements. T is float or double, here and below.
template <class T>
std::vector<T> chain_starts(std::size_t count) {
  std::vector<T> start(count);
  for (std::size_t i = 0; i < count; ++i) start[i] = static_cast<T>(i % 1021);
  return start;
}

/// Describes the first wrong sum after `rounds` rounds of x <- x * 1 + 1; empty if all are right.
template <class T>
std::string chain_fault(std::span<const T> start, std::span<const T> sums, std::uint32_t rounds) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const T right = 8 * start[i] + 28 + 8 * static_cast<T>(rounds);
    if (!(sums[i] == right))
      return "sum " + std::to_string(i) + " of chains of " + std::to_string(rounds) +
             " multiplications and additions is " + std::to_string(sums[i]) + ", not " +
             std::to_string(right);
  }
  return {};
}
template <class T>
std::string chain_fault(const std::vector<T>& start, const std::vector<T>& sums, std::uint32_t rounds) {
  return chain_fault(std::span<const T>(start), std::span<const T>(sums), rounds);
}

/// Describes the first wrong element of the part of the copy that starts at `first`; empty if all are right.
template <class T>
std::string copy_fault(const std::vector<T>& part, std::size_t first) {
  for (std::size_t i = 0; i < part.size(); ++i) {
    const T right = static_cast<T>((first + i) % 8191);
    if (!(part[i] == right))
      return "element " + std::to_string(first + i) + " of a copy is " + std::to_string(part[i]) + ", not " +
             std::to_string(right);
  }
  return {};
}

}  // namespace powercell
