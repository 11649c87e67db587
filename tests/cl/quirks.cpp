#include "lib/cl/quirks.hpp"

#include <doctest/doctest.h>

#include "tests/support/environment.hpp"

using namespace powercell;
using Type = DeviceInfo::Type;

namespace {

cl::Quirks quirks_of(const std::string& platform, Type type) {
  DeviceInfo device;
  device.platform_name = platform;
  device.type = type;
  return cl::quirks_of(device);
}

}  // namespace

TEST_CASE("quirks: GPUs get groups of several warps and launches of any size") {
  for (const char* platform : {"NVIDIA CUDA", "AMD Accelerated Parallel Processing", "rusticl"}) {
    const cl::Quirks gpu = quirks_of(platform, Type::gpu);
    CHECK(gpu.settings.group_size == 128);
    CHECK(gpu.launch_limit > std::uint64_t{1} << 32);
    CHECK_FALSE(gpu.compiles_at_launch);
    CHECK_FALSE(gpu.keeps_programs);
  }
}

TEST_CASE("quirks: only PoCL compiles at the launch and keeps programs, on whatever device") {
  for (const Type type : {Type::cpu, Type::gpu, Type::accelerator, Type::other}) {
    const cl::Quirks pocl = quirks_of("Portable Computing Language", type);
    CHECK(pocl.compiles_at_launch);
    CHECK(pocl.keeps_programs);
    const cl::Quirks other = quirks_of("Intel(R) OpenCL", type);
    CHECK_FALSE(other.compiles_at_launch);
    CHECK_FALSE(other.keeps_programs);
    CHECK(pocl.settings == other.settings);
    CHECK(pocl.launch_limit == other.launch_limit);
  }
}

TEST_CASE("quirks: PoCL's basic devices are called by one thread at a time, others by any") {
  DeviceInfo device;
  device.platform_name = "Portable Computing Language";
  device.name = "basic-haswell-EPYC";
  CHECK(cl::quirks_of(device).one_thread);
  CHECK(cl::call_alone(device).owns_lock());
  device.name = "pthread-haswell-EPYC";
  CHECK_FALSE(cl::quirks_of(device).one_thread);
  CHECK_FALSE(cl::call_alone(device).owns_lock());
}

TEST_CASE("quirks: a launch at a CPU's limit, rounded up to whole groups, stays below 2^16 work-items") {
  const cl::Quirks cpu = quirks_of("Intel(R) OpenCL", Type::cpu);
  CHECK(cpu.settings.group_size == 32);
  CHECK(cpu.launch_limit + cpu.settings.group_size < std::uint64_t{1} << 16);
  CHECK(cpu.launch_limit > std::uint64_t{1} << 15);
}

TEST_CASE("quirks: GPUs and accelerators take fewer lanes at once, unless the environment says otherwise") {
  const test::Environment unset("POWERCELL_LANES", "");
  DeviceInfo cpu, gpu, nvidia, accelerator, other;
  cpu.type = Type::cpu;
  gpu.type = nvidia.type = Type::gpu;
  nvidia.vendor = "NVIDIA Corporation";
  accelerator.type = Type::accelerator;
  for (const int cell_dimension : {2, 3}) {
    CHECK(cl::lane_width(cl::quirks_of(cpu).settings, cell_dimension) == 8);
    CHECK(cl::lane_width(cl::quirks_of(gpu).settings, cell_dimension) == 1);
    CHECK(cl::lane_width(cl::quirks_of(nvidia).settings, cell_dimension) == (cell_dimension == 2 ? 1 : 4));
    CHECK(cl::lane_width(cl::quirks_of(accelerator).settings, cell_dimension) == 1);
    CHECK(cl::lane_width(cl::quirks_of(other).settings, cell_dimension) == 8);
  }
  {
    const test::Environment eight("POWERCELL_LANES", "8");
    CHECK(cl::lane_width(cl::quirks_of(gpu).settings, 3) == 8);
  }
  {
    const test::Environment wrong("POWERCELL_LANES", "2");
    CHECK_THROWS_WITH_AS(cl::lane_width(cl::quirks_of(cpu).settings, 3),
                         doctest::Contains("POWERCELL_LANES is '2'"), Error);
  }
  const test::Environment one("POWERCELL_LANES", "1");
  CHECK(cl::lane_width(cl::quirks_of(cpu).settings, 3) == 1);
}

TEST_CASE("a kind that devices cannot be treated as is refused") {
  const test::Environment wrong("POWERCELL_TREAT_AS", "GPU");
  CHECK_THROWS_WITH_AS(devices(), doctest::Contains("POWERCELL_TREAT_AS is 'GPU'"), Error);
}
