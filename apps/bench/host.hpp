/// \file
/// The machine that a benchmark ran on, for its record.
#pragma once

#include <cstdint>
#include <string>

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

}  // namespace powercell::app
