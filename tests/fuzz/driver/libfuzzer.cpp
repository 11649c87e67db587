// libFuzzer's entry: POWERCELL_FUZZ_TARGET names the function of targets.hpp.
#include <sys/resource.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/targets.hpp"

namespace {

/// Beside libFuzzer's own figures, since wall time says little on a busy machine.
void print_processor_time() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::fprintf(stderr, "stat::processor_seconds:        %ld\n",
               static_cast<long>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec));
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  return std::atexit(print_processor_time);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    powercell::fuzz::POWERCELL_FUZZ_TARGET({data, size});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "finding: %s\n", error.what());
    __builtin_trap();  // libFuzzer keeps the input; std::abort would not do, OpenCL drivers catch its signal
  }
  return 0;
}
