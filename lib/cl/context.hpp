/// \file
/// An OpenCL context with its in-order queue and its compiled programs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <powercell/device_settings.hpp>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lib/cl/opencl.hpp"

namespace powercell::cl {

class Program;

class SharedContext {
 public:
  /// A new context, which of_device() finds from then on.
  /// \throw Error opencl
  static std::shared_ptr<SharedContext> make(cl_platform_id platform, cl_device_id device);
  /// The latest one made for the device, if a Context has it still; else null.
  static std::shared_ptr<SharedContext> of_device(cl_device_id device);
  /// That of a caller, retained.
  /// \throw Error opencl
  static std::shared_ptr<SharedContext> of_caller(cl_context context, cl_device_id device);

  SharedContext(cl_context context, cl_device_id device) : context_(context), device_(device) {}  // owns
  SharedContext(const SharedContext&) = delete;
  SharedContext& operator=(const SharedContext&) = delete;
  ~SharedContext();

  cl_context context() const { return context_; }
  cl_device_id device() const { return device_; }

  /// The program of a key, made by `build` at the first call. Others wait for it meanwhile.
  template <class Build>
  std::shared_ptr<const Program> program(const std::string& key, const Build& build) {
    const std::scoped_lock lock(building_);
    std::shared_ptr<const Program>& found = programs_[key];
    if (!found) found = build();
    return found;
  }
  /// Whether this is the first launch of a kernel with groups of `local`.
  bool is_first_launch(cl_program program, const std::string& kernel, std::size_t local);

 private:
  const cl_context context_;
  const cl_device_id device_;
  std::mutex building_;
  std::unordered_map<std::string, std::shared_ptr<const Program>> programs_;
  std::mutex recording_;
  std::set<std::tuple<cl_program, std::string, std::size_t>> launched_;
};

/// A GPU that draws a screen shows nothing during a launch, and its system ends one that takes seconds. How
/// long an item takes differs by more than a thousand between devices and precisions, so it is measured.
class LaunchSize {
 public:
  static constexpr std::size_t least = 1024;  ///< with fewer, most of any GPU has nothing to do
  static constexpr double wanted_seconds = .05;

  /// \param first  items of the first launch
  explicit LaunchSize(std::size_t first) : items_(std::max(first, least)) {}

  std::size_t items() const { return items_; }

  /// What a launch of at most items() took.
  void took(std::size_t items, double seconds) {
    constexpr double most_growth = 4;  // the first items may be cheaper than others
    // A few items take as long as many that run beside each other: they tell nothing where that is short.
    if (items < items_ && !(seconds > wanted_seconds)) return;
    const double factor = seconds > 0 ? std::min(wanted_seconds / seconds, most_growth) : most_growth;
    const double next = static_cast<double>(items) * factor;
    items_ = std::max(next < most_items ? static_cast<std::size_t>(next) : most, least);
  }

 private:
  static constexpr std::size_t most = std::size_t{1} << 30;
  static constexpr double most_items = most;

  std::size_t items_;
};

/// Throws unless `status` is CL_SUCCESS.
/// \param what  the operation, for the message
/// \throw Error out_of_device_memory for allocation failures; unsupported in a forked process and where the
/// loader lacks the function; else opencl, naming the code and `what`
void check(cl_int status, std::string_view what);
/// "CL_OUT_OF_RESOURCES" and so on for every code of OpenCL 1.2 and the ICD loader.
std::string error_name(cl_int status);

class Program;

/// Owns an event.
struct Event {
  explicit Event(cl_event given) : handle(given) {}
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;
  ~Event() { clReleaseEvent(handle); }
  /// CL_COMPLETE, a status above it while the command is not done, or one below it if it failed.
  cl_int state() const;
  /// Waits for the command.
  /// \return CL_SUCCESS, or why it or the wait failed
  cl_int wait() const;
  /// Whether the command may still use host memory, after wait() failed for another reason.
  bool is_pending() const;

  const cl_event handle;
};

class Context {
 public:
  /// With a queue of its own.
  /// \throw Error opencl
  Context(std::shared_ptr<SharedContext> shared, DeviceInfo info);
  explicit Context(cl_command_queue queue);  // retains
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context();

  cl_context context() const { return shared_->context(); }
  cl_command_queue queue() const { return queue_; }
  bool has_callers_queue() const { return callers_queue_; }
  bool profiles() const { return profiles_; }  ///< the queue
  cl_device_id device() const { return shared_->device(); }
  const DeviceInfo& info() const { return info_; }
  const DeviceSettings& settings() const { return settings_; }
  /// To be called before the first diagram: kernels keep what they were built with.
  void use(const DeviceSettings& settings) { settings_ = settings; }
  double build_seconds() const;
  void add_build_seconds(double seconds);
  /// Whether the driver compiles this kernel for groups of `local` at its next launch: true at the first call
  /// for drivers that compile at the first launch (quirks.hpp), else false.
  bool compiles_at_launch(const Program& program, const std::string& kernel, std::size_t local);
  /// How many work-items of the kernel to launch at a time, by what earlier launches took.
  std::size_t items_at_a_time(const Program& program, const std::string& kernel);
  void launch_took(const Program& program, const std::string& kernel, std::size_t items, double seconds);

  /// The program built from the embedded source `kernels/<file>` with -D `defines` (each "NAME=VALUE",
  /// kept in order); from memory, from the disk cache, or compiled. Thread-safe.
  /// \throw Error build_failed with device, options and log
  std::shared_ptr<const Program> program(std::string_view file, const std::vector<std::string>& defines);

  /// Blocks until the queue is empty.
  /// \throw Error opencl, also if a write noted before has failed
  void finish();
  /// A write that nobody waits for; its event.
  void note_write(std::weak_ptr<const Event> write);
  /// To be called after waiting for later commands: forgets the writes of this thread that are done.
  /// \throw Error opencl if one has failed, since what was computed with it is wrong
  void check_writes();

 private:
  /// Of the kernel. The caller holds record_mutex_.
  LaunchSize& launch_size(const Program& program, const std::string& kernel);

  std::shared_ptr<SharedContext> shared_;
  cl_command_queue queue_ = nullptr;
  bool callers_queue_ = false;
  bool profiles_ = true;
  DeviceInfo info_;
  DeviceSettings settings_;
  double build_seconds_ = 0;
  std::map<std::pair<cl_program, std::string>, LaunchSize> launch_sizes_;
  struct Write {
    std::thread::id thread;
    std::weak_ptr<const Event> event;
  };
  std::vector<Write> writes_;        // noted and not known to be done
  mutable std::mutex record_mutex_;  // guards build_seconds_, launch_sizes_ and writes_
};

}  // namespace powercell::cl
