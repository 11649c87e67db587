#include <algorithm>
#include <chrono>
#include <numeric>
#include <powercell/device_rates.hpp>

#include "lib/base/float_environment.hpp"
#include "lib/cl/choose.hpp"
#include "lib/cl/program.hpp"
#include "lib/device_rates/known.hpp"
#include "lib/device_rates/timed.hpp"

namespace powercell {
namespace {

constexpr double enough = 0.03;  // seconds of a launch: clocks resolve it, watchdogs allow it
constexpr std::size_t buffer_limit = std::size_t{256} << 20;  // bytes: exceeds the caches of today's devices
constexpr std::size_t items_per_unit = 2048;                  // work-items that fill a compute unit of a GPU

using ContextPointer = std::shared_ptr<cl::Context>;
using ProgramPointer = std::shared_ptr<const cl::Program>;

struct Rate {
  double best = 0, scatter = 0;
};

// Over several launches, each of which does `amount`.
Rate rate_of(const cl::Context& context, cl::Kernel& kernel, std::size_t items, double amount) {
  const Timed launches = timed({}, [&] {
    double seconds = 0;
    kernel.launch(items, 0, &seconds);
    return seconds;
  });
  if (launches.least > 0) return {amount / launches.least, launches.scatter};
  throw Error(ErrorCode::opencl, "device " + context.info().name +
                                     " reports no time for a kernel; its rates cannot be measured");
}

void require_no_fault(const cl::Context& context, const std::string& fault) {
  if (fault.empty()) return;
  throw Error(ErrorCode::self_test_failed,
              "device " + context.info().name + " computes wrong results: " + fault +
                  "; update its driver or choose another device (POWERCELL_DEVICE or --device)");
}

// Downloads in parts, so that the host needs little memory.
template <class T>
void check_copy(const cl::Context& context, const cl::Buffer<T>& copied) {
  std::vector<T> part(std::min<std::size_t>(copied.size(), std::size_t{1} << 20));
  for (std::size_t first = 0; first < copied.size(); first += part.size()) {
    part.resize(std::min(part.size(), copied.size() - first));
    copied.download(std::span<T>(part), first);
    require_no_fault(context, copy_fault<T>(part, first));
  }
}

template <class T>
Rate measure_copy(const ContextPointer& context, const ProgramPointer& program) {
  constexpr std::size_t packet = 16 / sizeof(T);
  const DeviceInfo& info = context->info();
  const std::size_t bytes = std::min<std::uint64_t>(
      {buffer_limit, info.largest_allocation / 2, std::max<std::uint64_t>(info.memory_bytes / 8, 1 << 20)});
  const std::size_t packets = bytes / 16;
  cl::Buffer<T> from(context), to(context);
  from.resize(packets * packet);
  to.resize(packets * packet);
  to.zero();
  cl::Kernel fill(context, program, "fill"), copy(context, program, "copy");
  fill.args(from, static_cast<cl_ulong>(from.size())).launch(from.size());
  copy.args(from, to, static_cast<cl_ulong>(packets)).launch(packets);  // compiles, touches the memory
  const Rate rate = rate_of(*context, copy, packets, 32.0 * static_cast<double>(packets));
  check_copy(*context, to);
  return rate;
}

template <class T>
Rate measure_multiply_add(const ContextPointer& context, const ProgramPointer& program) {
  constexpr std::size_t lanes = 64 / sizeof(T);
  const std::size_t items = std::max(1u, context->info().compute_units) * items_per_unit;
  const std::vector<T> start = chain_starts<T>(items * lanes);
  cl::Buffer<T> in(context), out(context);
  in.upload(start);
  out.resize(start.size());
  cl::Kernel kernel(context, program, "multiply_add");
  std::uint32_t rounds = 256;
  const auto count = static_cast<cl_uint>(items);
  kernel.args(in, out, T{1}, T{1}, cl_uint{rounds}, count).launch(items);  // compiles
  for (double seconds = 0; rounds < most_chain_rounds; rounds *= 2) {
    seconds = 0;
    kernel.args(in, out, T{1}, T{1}, cl_uint{rounds}, count).launch(items, 0, &seconds);
    if (seconds >= enough) break;
  }
  out.zero();
  kernel.args(in, out, T{1}, T{1}, cl_uint{rounds}, count);
  const double operations = 2.0 * 8 * static_cast<double>(lanes * items) * rounds;
  const Rate rate = rate_of(*context, kernel, items, operations);
  require_no_fault(*context, chain_fault<T>(start, out.download(), rounds));
  return rate;
}

template <class T>
DeviceRates measure_all(const ContextPointer& context) {
  const auto program =
      context->program("device_rates/device_rates.cl", {sizeof(T) == 8 ? "REAL_BITS=64" : "REAL_BITS=32"});
  const Rate copied = measure_copy<T>(context, program),
             operations = measure_multiply_add<T>(context, program);
  return {copied.best, operations.best, copied.scatter, operations.scatter};
}

// On the host, from the call to its end.
template <class Call>
Timed timed_calls(const Repeats& repeats, Call&& call) {
  return timed(repeats, [&] {
    const auto start = std::chrono::steady_clock::now();
    call();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  });
}

constexpr Repeats many{100, 100};  // of calls that do next to nothing

}  // namespace

DeviceLatencies measure_device_latencies(const Device& device) {
  const FloatEnvironment environment;
  cl::require_single(device, "latencies are those of");
  const ContextPointer& context = device.context();
  cl::Buffer<float> one(context);
  one.resize(1);
  one.upload(std::vector<float>{1});
  cl::Kernel fill(context, context->program("device_rates/device_rates.cl", {"REAL_BITS=32"}), "fill");
  fill.args(one, cl_ulong{1}).launch(1);  // compiles
  context->finish();
  const Timed launch = timed_calls(many, [&] {
    fill.launch(1);
    context->finish();
  });
  std::vector<float> read(1);
  const Timed transfer = timed_calls(many, [&] { one.download(std::span<float>(read)); });
  require_no_fault(*context, copy_fault<float>(read, 0));
  return {launch.least, transfer.least, launch.scatter, transfer.scatter};
}

DeviceTransfers measure_device_transfers(const Device& device, std::size_t bytes) {
  cl::require_single(device, "transfer rates are those of");
  if (bytes == 0) throw Error(ErrorCode::invalid_argument, "a transfer of 0 bytes has no rate");
  const ContextPointer& context = device.context();
  cl::Buffer<unsigned char> buffer(context);
  buffer.resize(bytes);  // first: what a device refuses the host need not have
  std::vector<unsigned char> sent(bytes), received(bytes);
  std::iota(sent.begin(), sent.end(), static_cast<unsigned char>(1));
  const auto send = [&] {
    buffer.upload(sent);
    context->finish();
  };
  send();  // the first use of the memory, on either side
  buffer.download(std::span<unsigned char>(received));
  std::fill(received.begin(), received.end(), static_cast<unsigned char>(0));
  constexpr Repeats repeats{9, 100, 0.1};
  const Timed to_device = timed_calls(repeats, send);
  const Timed to_host = timed_calls(repeats, [&] { buffer.download(std::span<unsigned char>(received)); });
  if (sent != received) require_no_fault(*context, "bytes sent there and back changed");
  const auto amount = static_cast<double>(bytes);
  return {amount / to_device.least, amount / to_host.least, to_device.scatter, to_host.scatter};
}

DeviceRates measure_device_rates(const Device& device, Precision precision) {
  const FloatEnvironment environment;
  cl::require_single(device, "rates are those of");
  const bool fp64 = device.info().fp64;
  if (precision == Precision::float64 && !fp64)
    throw Error(ErrorCode::no_fp64, "device \"" + device.info().name +
                                        "\" has no double precision; use single precision or another device");
  if (precision == Precision::float32 || !fp64) return measure_all<float>(device.context());
  return measure_all<double>(device.context());
}

}  // namespace powercell
