// libFuzzer's entry: POWERCELL_FUZZ_TARGET names the function of targets.hpp.
#include <cstddef>
#include <cstdio>

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    powercell::fuzz::POWERCELL_FUZZ_TARGET({data, size});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "finding: %s\n", error.what());
    __builtin_trap();  // libFuzzer keeps the input; std::abort would not do, OpenCL drivers catch its signal
  }
  return 0;
}
