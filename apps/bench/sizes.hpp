/// \file
/// The sizes of the benchmark: the same on every device, so that devices can be compared.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace powercell::app {

/// The row that stands for a device: white seeds in the cube, as many as `headline_seeds`.
inline constexpr std::size_t headline_seeds = 1'000'000, quick_headline_seeds = 100'000;
inline constexpr const char* headline_domain = "cube";

/// Numbers of seeds of the rows of a domain, ascending. Those of --quick are among the others.
std::vector<std::size_t> row_sizes(const std::string& domain, bool quick);

/// Of the time for runs that a row gets, relative to other rows: larger ones take longer.
double share_of_time(std::size_t n);

/// Why a row is left out, or nothing: its diagram does not fit into the memory of the device, or a run would
/// take half a minute.
/// \param rate  cells a second with fewer seeds; 0 if it is not known
std::string why_left_out(std::size_t n, std::uint64_t device_memory, double rate);

/// Bytes of the transfers that are measured, ascending by factors of four: 4 KiB to 256 MiB.
std::vector<std::size_t> transfer_sizes();
/// "64 KiB".
std::string bytes_text(std::size_t bytes);

}  // namespace powercell::app
