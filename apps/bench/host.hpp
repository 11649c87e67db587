/// \file
/// The machine that a benchmark ran on and what it did meanwhile, for the record.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace powercell::app {

/// What is not known is empty or 0.
struct HostInfo {
  std::string cpu;          ///< "AMD EPYC 7543 32-Core Processor"
  unsigned processors = 0;  ///< that the process may use
  std::uint64_t memory_bytes = 0;
  std::string system;         ///< "Debian GNU/Linux 12 (bookworm), Linux 6.1.0-18-amd64, x86_64"
  std::string opencl_loader;  ///< "OpenCL ICD Loader 2.3.1, /usr/lib/x86_64-linux-gnu/libOpenCL.so.1.0.0"
};

HostInfo host_info();

/// How busy the machine is and how fast its processors run at this moment, as far as the system says.
struct HostState {
  std::vector<double> load;       ///< averages of 1, 5 and 15 minutes, the benchmark included; or empty
  std::vector<double> clock_mhz;  ///< of each processor; or empty
  /// Seconds of all processors since the system started that programs and the system used, and that the host
  /// of this virtual machine took; and those that this process used, with what it started and waited for.
  std::optional<double> busy;
  double own = 0;
  double seconds = 0;  ///< on a steady clock
};

/// \param root  before the paths of the system's files, for tests
HostState host_state(const std::string& root = "");

/// How many processors others used between two moments, on average; nothing if the system does not say.
std::optional<double> used_by_others(const HostState& before, const HostState& after);

}  // namespace powercell::app
