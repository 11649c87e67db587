#include <algorithm>
#include <bit>
#include <chrono>
#include <utility>

#include "lib/cl/build_clock.hpp"
#include "lib/cl/program.hpp"
#include "lib/report/log.hpp"

namespace powercell::cl {
namespace {

/// A kernel on its way to the device.
struct Launch {
  cl_kernel kernel;
  const Context& context;
  const std::string& name;

  cl_command_queue queue() const { return context.queue(); }
  std::string what() const { return "running the kernel " + name + " on " + context.info().name; }
};

template <class T>
T group_value(const Launch& launch, cl_kernel_work_group_info which) {
  T value{};
  check(
      clGetKernelWorkGroupInfo(launch.kernel, launch.context.device(), which, sizeof value, &value, nullptr),
      launch.what() + ": asking for its work-group sizes");
  return value;
}

std::size_t choose_group_size(const Launch& launch) {
  struct Sizes {
    std::size_t x, y, z;
  };
  const DeviceInfo& info = launch.context.info();
  const auto required = group_value<Sizes>(launch, CL_KERNEL_COMPILE_WORK_GROUP_SIZE);
  if (required.x != 0) return required.x;
  const std::size_t limit = std::max<std::size_t>(
      1, std::min(group_value<std::size_t>(launch, CL_KERNEL_WORK_GROUP_SIZE), info.max_work_group_size));
  std::size_t wanted = launch.context.settings().group_size;
  // One size for all kernels where each size may be compiled apart; on a GPU whole warps.
  if (info.type == DeviceInfo::Type::gpu)
    wanted = std::max(wanted, group_value<std::size_t>(launch, CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE));
  return std::bit_floor(std::min(limit, wanted));
}

void finish_before(const Launch& launch) {
  check(clFinish(launch.queue()), launch.what() + ": waiting for the commands before it");
}

void enqueue(const Launch& launch, std::size_t global, std::size_t local, cl_event* event,
             std::size_t first = 0) {
  const cl_int status =
      clEnqueueNDRangeKernel(launch.queue(), launch.kernel, 1, &first, &global, &local, 0, nullptr, event);
  if (status != CL_SUCCESS)
    check(status, launch.what() + ", " + std::to_string(global) + " work-items in groups of " +
                      std::to_string(local));
}

/// Seconds between start and end of the event, waiting for it; releases it.
double event_seconds(cl_event event, const std::string& what) {
  cl_int failure = clWaitForEvents(1, &event);
  if (failure == CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST) {
    // The event's own status says why.
    cl_int execution = CL_SUCCESS;
    clGetEventInfo(event, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof execution, &execution, nullptr);
    if (execution < 0) failure = execution;
  }
  cl_ulong start = 0, end = 0;
  if (failure == CL_SUCCESS)
    failure = clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start, nullptr);
  if (failure == CL_SUCCESS)
    failure = clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr);
  clReleaseEvent(event);
  check(failure, what);
  return end > start ? 1e-9 * static_cast<double>(end - start) : 0.0;
}

/// The first launch of a kernel with a group size, for drivers that compile only then: waits for the end and
/// counts the time outside the execution as compilation, not as time of the kernel.
double compiling_launch(Context& context, const Launch& launch, std::size_t global, std::size_t local,
                        std::size_t first = 0) {
  finish_before(launch);
  const BuildClock clock;
  cl_event event = nullptr;
  enqueue(launch, global, local, &event, first);
  const double execution = event_seconds(event, launch.what());
  const double seconds = clock.done(context, execution);
  write_log(LogLevel::detail, [&] {
    return launch.what() + ", groups of " + std::to_string(local) + ", for the first time: compiled in " +
           in_seconds(seconds);
  });
  return execution;
}

/// For a caller's queue that does not profile: the wall clock, with the queue emptied before and after.
double wall_seconds(const Launch& launch, std::size_t global, std::size_t local) {
  finish_before(launch);
  const auto start = std::chrono::steady_clock::now();
  enqueue(launch, global, local, nullptr);
  check(clFinish(launch.queue()), launch.what());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Kernel::Kernel(std::shared_ptr<Context> context, std::shared_ptr<const Program> program,
               const std::string& name)
    : context_(std::move(context)), program_(std::move(program)), name_(name) {
  cl_int status = CL_SUCCESS;
  kernel_ = clCreateKernel(program_->handle(), name_.c_str(), &status);
  check(status, "creating the kernel " + name_);
  status = clGetKernelInfo(kernel_, CL_KERNEL_NUM_ARGS, sizeof argument_count_, &argument_count_, nullptr);
  if (status != CL_SUCCESS) clReleaseKernel(kernel_);  // no destructor runs where a constructor throws
  check(status, "counting the arguments of the kernel " + name_);
}

Kernel::Kernel(Kernel&& other) noexcept
    : context_(std::move(other.context_)),
      program_(std::move(other.program_)),
      kernel_(std::exchange(other.kernel_, nullptr)),
      name_(std::move(other.name_)),
      group_size_(other.group_size_),
      argument_count_(other.argument_count_),
      arguments_set_(other.arguments_set_) {}

Kernel& Kernel::operator=(Kernel&& other) noexcept {
  if (this == &other) return *this;
  if (kernel_) clReleaseKernel(kernel_);
  context_ = std::move(other.context_);
  program_ = std::move(other.program_);
  kernel_ = std::exchange(other.kernel_, nullptr);
  name_ = std::move(other.name_);
  group_size_ = other.group_size_;
  argument_count_ = other.argument_count_;
  arguments_set_ = other.arguments_set_;
  return *this;
}

Kernel::~Kernel() {
  if (kernel_) clReleaseKernel(kernel_);
}

std::size_t Kernel::group_size() {
  if (group_size_ == 0) group_size_ = choose_group_size({kernel_, *context_, name_});
  return group_size_;
}

void Kernel::launch(std::size_t global, std::size_t local, double* seconds) {
  if (global == 0) return;
  require_all_arguments();
  const Launch launch{kernel_, *context_, name_};
  if (local == 0) local = group_size();
  global = (global + local - 1) / local * local;
  if (context_->profiles() && context_->compiles_at_launch(*program_, name_, local)) {
    const double execution = compiling_launch(*context_, launch, global, local);
    if (seconds) *seconds += execution;
  } else if (!seconds) {
    enqueue(launch, global, local, nullptr);
  } else if (context_->profiles()) {
    cl_event event = nullptr;
    enqueue(launch, global, local, &event);
    *seconds += event_seconds(event, launch.what());
  } else {
    *seconds += wall_seconds(launch, global, local);
  }
}

void Kernel::launch_in_parts(std::size_t global) {
  if (context_->info().type == DeviceInfo::Type::cpu || !context_->profiles()) return launch(global);
  require_all_arguments();
  const Launch how{kernel_, *context_, name_};
  const std::size_t local = group_size();
  for (std::size_t first = 0; first < global;) {
    std::size_t items = std::min(context_->items_at_a_time(*program_, name_), global - first);
    items = (items + local - 1) / local * local;
    double seconds = 0;
    if (context_->compiles_at_launch(*program_, name_, local)) {
      seconds = compiling_launch(*context_, how, items, local, first);
    } else {
      cl_event event = nullptr;
      enqueue(how, items, local, &event, first);
      seconds = event_seconds(event, how.what());
    }
    context_->launch_took(*program_, name_, items, seconds);
    first += items;
  }
}

void Kernel::submit(std::size_t global, std::size_t local, cl_event* done) {
  if (global == 0) return;
  require_all_arguments();
  const Launch launch{kernel_, *context_, name_};
  if (local == 0) local = group_size();
  global = (global + local - 1) / local * local;
  // Nothing holds back a queue of the library's own, so the compilation can be waited for, and counted.
  if (!done && !context_->has_callers_queue() && context_->compiles_at_launch(*program_, name_, local))
    compiling_launch(*context_, launch, global, local);
  else
    enqueue(launch, global, local, done);
}

void Kernel::require_all_arguments() const {
  if (arguments_set_ == argument_count_) return;
  throw Error(ErrorCode::internal, "the kernel " + name_ + " has " + std::to_string(argument_count_) +
                                       " arguments, but " + std::to_string(arguments_set_) +
                                       " are set at its launch");
}

void Kernel::set_memory(cl_uint index, cl_mem memory) {
  set_bytes(index, sizeof memory, &memory);
}

void Kernel::set_bytes(cl_uint index, std::size_t size, const void* value) {
  check(clSetKernelArg(kernel_, index, size, value),
        "setting argument " + std::to_string(index) + " of the kernel " + name_);
}

}  // namespace powercell::cl
