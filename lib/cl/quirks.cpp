#include "lib/cl/quirks.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

// Workarounds that cost nothing apply to every device and have no row in the table below:
// - PoCL keeps short loops over private arrays rolled up, and so the arrays in memory
//   (github.com/pocl/pocl/issues/825): UNROLL in kernels/base/real.cl.
// - Intel's CPU compiler reorders plain sums in scalar code: add_column in kernels/integrate/gather.cl.
// - OpenCL does not say how dot() and cross() round: kernels/base/lanes.cl has its own.
// - Compilers fuse a * b + c although told not to (github.com/SixTrack/sixtracklib/issues/131):
//   lib/cl/self_test.cpp refuses such devices.
// - Drivers miscompile large kernels (github.com/pocl/pocl/issues/979): lib/clip/golden.cpp refuses those.
// - NVIDIA's driver allocates a buffer at its first use, too late to try a smaller one
//   (github.com/arrayfire/arrayfire/issues/2650): lib/cl/buffer.cpp migrates it to the device at once.
// - Some drivers fill a buffer pattern by pattern: lib/cl/buffer.cpp takes the widest that fits.
// - Devices of OpenCL 1.1 do not know CL_DEVICE_DOUBLE_FP_CONFIG: lib/cl/enumerate.cpp takes that for a no.
// - Drivers refuse a binary of their own, or hand out none: lib/cl/program_build.cpp compiles again.
// - PoCL's first queries must not meet those of another thread: lib/cl/enumerate.cpp lets one list devices.
// - PoCL and NVIDIA's driver read settings from the environment, once: limit_threads in apps/common.cpp,
//   set_caches_aside in apps/bench.cpp.

namespace powercell::cl {
namespace {

bool is_gpu(const DeviceInfo& device) {
  return device.type == DeviceInfo::Type::gpu;
}
bool is_accelerator(const DeviceInfo& device) {
  return device.type == DeviceInfo::Type::accelerator;
}
bool is_nvidia(const DeviceInfo& device) {
  return is_gpu(device) && device.vendor.find("NVIDIA") != std::string::npos;
}
bool is_cpu(const DeviceInfo& device) {
  return device.type == DeviceInfo::Type::cpu;
}
bool is_pocl(const DeviceInfo& device) {
  return device.platform_name == "Portable Computing Language";
}
bool is_basic_pocl(const DeviceInfo& device) {
  return is_pocl(device) && device.name.starts_with("basic");
}

void one_by_one(Quirks& quirks, const DeviceInfo&) {
  quirks.settings.polygon_lanes = quirks.settings.polyhedron_lanes = 1;
}

/// A condition on the device and the change that it makes. Later rows overrule earlier ones.
struct Row {
  bool (*applies)(const DeviceInfo&);
  void (*change)(Quirks&, const DeviceInfo&);
};

constexpr Row table[] = {
    // GPUs: several warps a group, but few enough to leave each work-item its registers.
    {is_gpu, [](Quirks& quirks, const DeviceInfo&) { quirks.settings.group_size = 128; }},

    // On CPUs vectors of eight are twice as fast. On GPUs they take all registers (docs/gpu_costs.md).
    {is_gpu, one_by_one},
    {is_accelerator, one_by_one},

    // Work-items wait for their private memory: four numbers a load are a sixth faster for polyhedra on an
    // H200
    // in single precision and 7 % in double (docs/records/gpu.md). Eight were 3 % faster still, but take all
    // registers. AMD's compiler needs twice as many registers for four and has not been measured.
    {is_nvidia, [](Quirks& quirks, const DeviceInfo&) { quirks.settings.polyhedron_lanes = 4; }},

    // With 2^18 pairs a launch an H200 waits for the last ones 7 % of the time (docs/records/gpu.md). Not so
    // many that double precision on a GPU for displays takes a second.
    {is_nvidia,
     [](Quirks& quirks, const DeviceInfo& device) {
       auto& pairs = quirks.settings.launch_pairs;
       pairs = std::max(pairs, std::uint64_t{device.compute_units} << 12);
     }},

    // A GPU needs many pairs to be busy. A core of a CPU needs a few groups, and collects the output of a
    // small chunk
    // from its cache.
    {is_cpu,
     [](Quirks& quirks, const DeviceInfo& device) {
       quirks.settings.chunk_pairs =
           std::clamp<std::uint64_t>(std::uint64_t{device.compute_units} << 14, 1 << 14, 1 << 22);
     }},

    // PoCL compiles a kernel once for grids of less than 2^16 work-items and once for larger ones
    // (github.com/pocl/pocl/pull/738). The limit holds on every CPU, so that chunks are the same with every
    // driver; the margin is for rounding up to whole groups.
    {is_cpu,
     [](Quirks& quirks, const DeviceInfo&) { quirks.launch_limit = (std::uint64_t{1} << 16) - 4096; }},

    // PoCL specialises a kernel by its group size when it is launched (github.com/pocl/pocl/issues/1958) and
    // keeps the result in its own folder; a cache of binaries on top makes it compile a general form besides
    // (github.com/inducer/pyopencl/issues/731).
    {is_pocl,
     [](Quirks& quirks, const DeviceInfo&) {
       quirks.compiles_at_launch = true;
       quirks.keeps_programs = true;
     }},

    // The devices of PoCL that run commands in the thread that enqueues them (POCL_DEVICES=basic) lock an
    // event of another thread's command while that thread waits for theirs: PoCL 3.1,
    // tests/devices/same_bits.cpp.
    {is_basic_pocl, [](Quirks& quirks, const DeviceInfo&) { quirks.one_thread = true; }},
};

}  // namespace

Quirks quirks_of(const DeviceInfo& device) {
  Quirks quirks;
  for (const Row& row : table)
    if (row.applies(device)) row.change(quirks, device);
  return quirks;
}

std::unique_lock<std::recursive_mutex> call_alone(const DeviceInfo& device) {
  static std::recursive_mutex calling;
  return quirks_of(device).one_thread ? std::unique_lock(calling) : std::unique_lock<std::recursive_mutex>();
}

int lane_width(const DeviceSettings& settings, int cell_dimension) {
  const char* set = std::getenv("POWERCELL_LANES");
  const std::string_view wish = set ? set : "";
  if (wish.empty()) return cell_dimension == 3 ? settings.polyhedron_lanes : settings.polygon_lanes;
  for (const int width : {1, 4, 8})
    if (wish == std::to_string(width)) return width;
  throw Error(ErrorCode::invalid_argument, "the environment variable POWERCELL_LANES is '" +
                                               std::string(wish) + "'; 1, 4 or 8 is expected");
}

}  // namespace powercell::cl
