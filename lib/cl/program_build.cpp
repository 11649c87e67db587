#include "lib/cl/program_build.hpp"

#include <algorithm>
#include <cstdlib>
#include <powercell/version.hpp>

#include "lib/cl/build_clock.hpp"
#include "lib/cl/enumerate.hpp"
#include "lib/cl/program_source.hpp"
#include "lib/cl/quirks.hpp"
#include "lib/report/log.hpp"

namespace powercell::cl {
namespace {

constexpr std::size_t longest_log = 4000;  // characters in a message; the first errors say the most

cl_platform_id platform_of(cl_device_id device) {
  cl_platform_id platform = nullptr;
  check(clGetDeviceInfo(device, CL_DEVICE_PLATFORM, sizeof platform, &platform, nullptr),
        "asking a device for its platform");
  return platform;
}

std::string build_log(cl_program program, cl_device_id device) {
  std::size_t size = 0;
  if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size) != CL_SUCCESS)
    return {};
  std::string log(size, '\0');
  if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr) != CL_SUCCESS)
    return {};
  std::erase(log, '\0');
  log.erase(std::find_if(log.rbegin(), log.rend(), [](unsigned char c) { return c > ' '; }).base(),
            log.end());
  if (log.size() > longest_log) {
    const std::size_t left_out = log.size() - longest_log;
    log.resize(longest_log);
    log += "\n[... " + std::to_string(left_out) + " more characters]";
  }
  return log.empty() ? "(the driver gave no log)" : log;
}

std::shared_ptr<Program> compile(const Context& context, const ProgramRequest& request) {
  cl_int status = CL_SUCCESS;
  const char* text = request.source.data();
  const std::size_t length = request.source.size();
  cl_program handle = clCreateProgramWithSource(context.context(), 1, &text, &length, &status);
  check(status, "creating the program " + request.name);
  auto program = std::make_shared<Program>(handle, context.device());
  const cl_device_id device = context.device();
  status = clBuildProgram(handle, 1, &device, request.options.c_str(), nullptr, nullptr);
  if (status == CL_SUCCESS) return program;
  const DeviceInfo& info = context.info();
  throw Error(ErrorCode::build_failed,
              request.name + " does not build: " + error_name(status) + "\n  device: " + info.name + " (" +
                  info.platform_name + ", driver " + info.driver_version +
                  ")\n  options: " + request.options + "\n  log:\n" + build_log(handle, device));
}

/// Null if the driver refuses the binary for any reason; the caller then compiles the source.
std::shared_ptr<Program> load(const Context& context, const ProgramRequest& request, const Binary& binary) {
  const cl_device_id device = context.device();
  const unsigned char* bytes = binary.data();
  const std::size_t size = binary.size();
  cl_int binary_status = CL_SUCCESS, status = CL_SUCCESS;
  cl_program handle =
      clCreateProgramWithBinary(context.context(), 1, &device, &size, &bytes, &binary_status, &status);
  if (!handle) return nullptr;
  auto program = std::make_shared<Program>(handle, device);
  if (status != CL_SUCCESS || binary_status != CL_SUCCESS) return nullptr;
  if (clBuildProgram(handle, 1, &device, request.options.c_str(), nullptr, nullptr) != CL_SUCCESS)
    return nullptr;
  return program;
}

/// Empty if the driver returns none.
Binary binary_of(const Program& program) {
  // A caller's context may hold several devices; the binaries come for all of them, in its order.
  cl_uint count = 0;
  if (clGetProgramInfo(program.handle(), CL_PROGRAM_NUM_DEVICES, sizeof count, &count, nullptr) != CL_SUCCESS)
    return {};
  std::vector<cl_device_id> devices(count);
  std::vector<std::size_t> sizes(count);
  const std::size_t device_bytes = count * sizeof(cl_device_id), size_bytes = count * sizeof(std::size_t);
  if (clGetProgramInfo(program.handle(), CL_PROGRAM_DEVICES, device_bytes, devices.data(), nullptr) !=
          CL_SUCCESS ||
      clGetProgramInfo(program.handle(), CL_PROGRAM_BINARY_SIZES, size_bytes, sizes.data(), nullptr) !=
          CL_SUCCESS)
    return {};
  std::vector<Binary> binaries(count);
  std::vector<unsigned char*> targets(count, nullptr);
  std::size_t ours = count;
  for (std::size_t i = 0; i < count; ++i) {
    binaries[i].resize(sizes[i]);
    targets[i] = binaries[i].data();
    if (devices[i] == program.device()) ours = i;
  }
  if (ours == count || clGetProgramInfo(program.handle(), CL_PROGRAM_BINARIES, count * sizeof(unsigned char*),
                                        targets.data(), nullptr) != CL_SUCCESS)
    return {};
  return std::move(binaries[ours]);
}

}  // namespace

Program::~Program() {
  clReleaseProgram(program_);
}

void Program::trust_after(const std::function<void()>& test) const {
  if (trusted_) return;
  const std::scoped_lock lock(testing_);
  if (trusted_ || under_test_) return;
  under_test_ = true;
  try {
    test();
  } catch (...) {
    under_test_ = false;
    throw;
  }
  under_test_ = false;
  trusted_ = true;
}

std::string build_options(const std::vector<std::string>& defines) {
  // -w: without AVX-512, PoCL's compiler warns of each function that takes or returns a double8, and counts
  // its warnings on the caller's standard error.
  std::string options = "-cl-std=CL1.2 -w";
  for (const auto& define : defines) {
    if (define.empty() || define.find_first_of(" \t\n\"") != std::string::npos)
      throw Error(ErrorCode::internal,
                  "a kernel define must be NAME=VALUE without blanks: \"" + define + "\"");
    options += " -D" + define;
  }
  return options;
}

CacheKey cache_key(const Context& context, const ProgramRequest& request) {
  const DeviceInfo& info = context.info();
  const std::string platform_version = platform_text(platform_of(context.device()), CL_PLATFORM_VERSION);
  const std::string_view parts[] = {request.source, request.options, info.platform_name,  platform_version,
                                    info.name,      info.vendor,     info.driver_version, POWERCELL_VERSION};
  return CacheKey::of(parts);
}

bool uses_disk_cache(const Context& context) {
  const char* set = std::getenv("POWERCELL_CACHE");
  const std::string_view wish = set ? set : "";
  if (wish == "always") return true;
  if (wish == "never") return false;
  return !quirks_of(context.info()).keeps_programs;
}

std::shared_ptr<const Program> build_program(const Context& context, const ProgramRequest& request,
                                             const DiskCache* cache, ProgramOrigin* origin) {
  if (origin) *origin = ProgramOrigin::compiled;
  if (!cache) return compile(context, request);
  const CacheKey key = cache_key(context, request);
  if (const auto binary = cache->read(key)) {
    if (auto program = load(context, request, *binary)) {
      if (origin) *origin = ProgramOrigin::disk;
      return program;
    }
    cache->remove(key);
  }
  auto program = compile(context, request);
  if (const Binary binary = binary_of(*program); !binary.empty() && !cache->write(key, binary))
    write_log(LogLevel::info, [&] {
      return "the compiled " + request.name + " cannot be kept in \"" + cache->folder().string() + "\"";
    });
  return program;
}

std::shared_ptr<const Program> Context::program(std::string_view file,
                                                const std::vector<std::string>& defines) {
  const std::string options = build_options(defines);
  return shared_->program(std::string(file) + '\n' + options, [&] {
    const BuildClock clock;
    const ProgramRequest request{"kernels/" + std::string(file), expand_includes(embedded_kernels(), file),
                                 options};
    const DiskCache cache(DiskCache::default_folder());
    ProgramOrigin origin{};
    auto program = build_program(*this, request, uses_disk_cache(*this) ? &cache : nullptr, &origin);
    const bool compiled = origin == ProgramOrigin::compiled;
    const double seconds = compiled ? clock.done(*this) : clock.seconds();
    write_log(compiled ? LogLevel::info : LogLevel::detail, [&] {
      return request.name + (compiled ? " built in " : " taken from the cache in ") + in_seconds(seconds) +
             ": " + options;
    });
    return program;
  });
}

}  // namespace powercell::cl
