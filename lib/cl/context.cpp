#include "lib/cl/context.hpp"

#include <chrono>
#include <map>
#include <thread>
#include <utility>

#include "lib/cl/enumerate.hpp"
#include "lib/cl/program.hpp"
#include "lib/cl/quirks.hpp"
#include "lib/cl/settings_file.hpp"
#include "lib/report/log.hpp"

namespace powercell::cl {

namespace {

template <class T>
T queue_value(cl_command_queue queue, cl_command_queue_info which) {
  T value{};
  check(clGetCommandQueueInfo(queue, which, sizeof value, &value, nullptr), "asking a queue for a property");
  return value;
}

void log_device(const DeviceInfo& info) {
  write_log(LogLevel::info, [&] {
    return "device " + info.selector() + ": " + info.name + " (" + info.platform_name + ", driver " +
           info.driver_version + "), " + (info.fp64 ? "double and single" : "single") + " precision";
  });
}

/// The device; for a part of a device, the whole.
cl_device_id whole_of(cl_device_id device) {
  cl_device_id parent = device;
  for (cl_device_id up = device; up;) {
    parent = up;
    if (clGetDeviceInfo(parent, CL_DEVICE_PARENT_DEVICE, sizeof up, &up, nullptr) != CL_SUCCESS) break;
  }
  return parent;
}

}  // namespace

Context::Context(std::shared_ptr<SharedContext> shared, DeviceInfo info)
    : shared_(std::move(shared)), info_(std::move(info)), settings_(measured_settings(info_)) {
  cl_int status = CL_SUCCESS;
  queue_ = clCreateCommandQueue(context(), device(), CL_QUEUE_PROFILING_ENABLE, &status);
  check(status, "creating a queue on " + info_.name);
  log_device(info_);
}

Context::Context(cl_command_queue queue) {
  if (!queue) throw Error(ErrorCode::invalid_argument, "the caller's command queue is null");
  const auto properties = queue_value<cl_command_queue_properties>(queue, CL_QUEUE_PROPERTIES);
  if (properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE)
    throw Error(ErrorCode::invalid_argument,
                "the caller's command queue is out of order; create it without "
                "CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE");
  profiles_ = (properties & CL_QUEUE_PROFILING_ENABLE) != 0;
  const auto device = queue_value<cl_device_id>(queue, CL_QUEUE_DEVICE);
  cl_platform_id platform = nullptr;
  check(clGetDeviceInfo(device, CL_DEVICE_PLATFORM, sizeof platform, &platform, nullptr),
        "asking the caller's device for its platform");
  info_ = describe(platform, device);
  find_indices(platform, whole_of(device), info_);
  settings_ = measured_settings(info_);
  shared_ = SharedContext::of_caller(queue_value<cl_context>(queue, CL_QUEUE_CONTEXT), device);
  check(clRetainCommandQueue(queue), "retaining the caller's queue");
  queue_ = queue;
  callers_queue_ = true;
  log_device(info_);
}

Context::~Context() {
  clReleaseCommandQueue(queue_);
}

double Context::build_seconds() const {
  std::lock_guard lock(record_mutex_);
  return build_seconds_;
}

void Context::add_build_seconds(double seconds) {
  std::lock_guard lock(record_mutex_);
  build_seconds_ += seconds;
}

bool Context::compiles_at_launch(const Program& program, const std::string& kernel, std::size_t local) {
  return quirks_of(info_).compiles_at_launch && shared_->is_first_launch(program.handle(), kernel, local);
}

LaunchSize& Context::launch_size(const Program& program, const std::string& kernel) {
  // Enough for each unit to have several groups to wait for memory in turns with, and few for the slowest.
  const std::size_t first = std::size_t{info_.compute_units} << 9;
  return launch_sizes_.try_emplace({program.handle(), kernel}, first).first->second;
}

std::size_t Context::items_at_a_time(const Program& program, const std::string& kernel) {
  const std::lock_guard lock(record_mutex_);
  return launch_size(program, kernel).items();
}

void Context::launch_took(const Program& program, const std::string& kernel, std::size_t items,
                          double seconds) {
  const std::lock_guard lock(record_mutex_);
  launch_size(program, kernel).took(items, seconds);
}

void Context::finish() {
  check(clFinish(queue_), "waiting for " + info_.name);
  check_writes();
}

cl_int Event::state() const {
  cl_int state = CL_QUEUED;
  const cl_int asked =
      clGetEventInfo(handle, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof state, &state, nullptr);
  return asked == CL_SUCCESS ? state : asked;
}

cl_int Event::wait() const {
  return clWaitForEvents(1, &handle);
}

bool Event::is_pending() const {
  constexpr int tries = 1000;
  for (int k = 0; k < tries; ++k) {
    if (state() <= CL_COMPLETE) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

void Context::note_write(std::weak_ptr<const Event> write) {
  constexpr std::size_t many = 64;  // where nobody waits for results, as of a caller's queue
  const std::lock_guard lock(record_mutex_);
  if (writes_.size() >= many)
    std::erase_if(writes_, [](const Write& noted) { return noted.event.expired(); });
  writes_.push_back({std::this_thread::get_id(), std::move(write)});
}

void Context::check_writes() {
  cl_int failure = CL_SUCCESS;
  {
    const std::lock_guard lock(record_mutex_);
    std::erase_if(writes_, [&](const Write& noted) {
      if (noted.thread != std::this_thread::get_id()) return noted.event.expired();
      const std::shared_ptr<const Event> write = noted.event.lock();
      const cl_int state = write ? write->state() : CL_COMPLETE;
      if (state < CL_COMPLETE) failure = state;
      return state <= CL_COMPLETE;
    });
  }
  check(failure, "writing to " + info_.name);
}

namespace {

/// Those that are there. A context and a device name one; of our own the device alone, with a null context.
struct Registry {
  std::mutex mutex;
  std::map<std::pair<cl_context, cl_device_id>, std::weak_ptr<SharedContext>> known;
};

Registry& registry() {
  static Registry& of_process = *new Registry;  // used by destructors of other static objects
  return of_process;
}

}  // namespace

std::shared_ptr<SharedContext> SharedContext::make(cl_platform_id platform, cl_device_id device) {
  const cl_context_properties properties[] = {CL_CONTEXT_PLATFORM,
                                              reinterpret_cast<cl_context_properties>(platform), 0};
  cl_int status = CL_SUCCESS;
  const cl_context context = clCreateContext(properties, 1, &device, nullptr, nullptr, &status);
  check(status, "creating a context");
  auto made = std::make_shared<SharedContext>(context, device);
  const std::scoped_lock lock(registry().mutex);
  registry().known[{nullptr, device}] = made;
  return made;
}

std::shared_ptr<SharedContext> SharedContext::of_device(cl_device_id device) {
  const std::scoped_lock lock(registry().mutex);
  return registry().known[{nullptr, device}].lock();
}

std::shared_ptr<SharedContext> SharedContext::of_caller(cl_context context, cl_device_id device) {
  const std::scoped_lock lock(registry().mutex);
  auto& all = registry().known;
  std::erase_if(all, [](const auto& entry) { return entry.second.expired(); });  // hosts may make many
  std::weak_ptr<SharedContext>& known = all[{context, device}];
  if (auto found = known.lock()) return found;
  check(clRetainContext(context), "retaining the caller's context");
  auto made = std::make_shared<SharedContext>(context, device);
  known = made;
  return made;
}

SharedContext::~SharedContext() {
  programs_.clear();
  clReleaseContext(context_);
}

bool SharedContext::is_first_launch(cl_program program, const std::string& kernel, std::size_t local) {
  const std::scoped_lock lock(recording_);
  return launched_.emplace(program, kernel, local).second;
}

}  // namespace powercell::cl
