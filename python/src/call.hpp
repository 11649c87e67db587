/// \file
/// Calls of the library from Python: without the interpreter's lock, and with Ctrl-C, the caller's functions
/// and their exceptions.
#pragma once

#include <exception>
#include <memory>
#include <mutex>
#include <utility>

#include "python/src/arrays.hpp"

namespace powercell::python {

/// While one lives, a thread may be without the interpreter's lock; made and destroyed with it. The
/// interpreter's end waits for all of them, and no thread comes back from one after that: it would take a
/// lock that is gone.
class InFlight {
 public:
  /// \throw Error unsupported in the thread that ends the interpreter
  InFlight();
  ~InFlight();
  InFlight(const InFlight&) = delete;
  InFlight& operator=(const InFlight&) = delete;

  static bool ending();  ///< calls have to stop: the interpreter ends
  /// Ends the interpreter's calls. Python calls it when it exits.
  static void end_all();
};

/// Runs `function` without the interpreter's lock.
template <class Function>
auto without_lock(const Function& function) {
  const InFlight counted;
  const nb::gil_scoped_release released;
  return function();
}

/// An object of Python that may be let go of in any thread.
std::shared_ptr<nb::object> shared(nb::object object);

/// One call. Functions that run within it report exceptions of Python, which come out of run() unchanged.
class Call {
 public:
  /// \param progress  None, or a function of what is reported, which may return False to stop
  /// \param owner  what runs the call, if its functions must not come back to it
  explicit Call(nb::object progress, const void* owner = nullptr)
      : progress_(std::move(progress)), owner_(owner), outer_(innermost()) {}

  /// Runs `function` without the interpreter's lock.
  template <class Function>
  auto run(const Function& function) {
    try {
      return without_lock(function);
    } catch (...) {
      if (exception_) std::rethrow_exception(exception_);
      throw;
    }
  }

  /// Looks for Ctrl-C. \return false to stop; called without the interpreter's lock
  bool check() {
    return python([] { throw_if_interrupted(); });
  }
  /// The same, and passes a fraction done or a step on to the progress function.
  template <class State>
  bool report(const State& state) {
    bool go_on = true;
    const bool ran = python([&] {
      throw_if_interrupted();
      if (progress_.is_none()) return;
      const nb::object answer = progress_(state);
      go_on = answer.is_none() || nb::cast<bool>(nb::bool_(answer));
    });
    return ran && go_on;
  }

  /// \throw Error invalid_argument if this call was made, over any others, by a function of a call of `owner`
  void require_not_within(const void* owner) const;

  /// Runs a function of Python from any thread. \return false if it threw, now or before
  template <class Function>
  bool python(const Function& function) {
    return run_python(function, false);
  }
  /// The same, also if one threw before. \return false if this one threw
  template <class Function>
  bool python_in_any_case(const Function& function) {
    return run_python(function, true);
  }

 private:
  template <class Function>
  bool run_python(const Function& function, bool in_any_case) {
    if (InFlight::ending()) return false;
    const nb::gil_scoped_acquire acquired;
    if (exception_ && !in_any_case) return false;
    const Inside inside(this);
    try {
      function();
      return true;
    } catch (...) {
      if (!exception_) exception_ = std::current_exception();
      return false;
    }
  }

  static void throw_if_interrupted() {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }

  /// The call whose function of Python runs in this thread.
  static const Call*& innermost();
  struct Inside {
    explicit Inside(const Call* call) : before(std::exchange(innermost(), call)) {}
    ~Inside() { innermost() = before; }
    const Call* before;
  };

  nb::object progress_;
  const void* owner_;
  const Call* outer_;             // within whose function of Python this call was made
  std::exception_ptr exception_;  // guarded by the interpreter's lock
};

/// What an object of the library that keeps its callbacks is called with: the call that is running.
/// Calls from several threads wait for each other.
class CallSlot {
 public:
  template <class Function>
  auto run(nb::object progress, const Function& function) {
    Call call(std::move(progress), this);
    call.require_not_within(this);
    return call.run([&] {
      const std::scoped_lock lock(mutex_);
      call_ = &call;
      struct Reset {
        Call*& call;
        ~Reset() { call = nullptr; }
      } reset{call_};
      return function();
    });
  }
  Call* current() const { return call_; }
  bool check() const { return !call_ || call_->check(); }
  template <class State>
  bool report(const State& state) const {
    return !call_ || call_->report(state);
  }

 private:
  std::mutex mutex_;
  Call* call_ = nullptr;  // guarded by the mutex
};

void bind_devices(nb::module_& m);
void bind_queues(nb::module_& m);
void bind_domains(nb::module_& m);
void bind_results(nb::module_& m);
void bind_densities(nb::module_& m);
void bind_point_sets(nb::module_& m);
void bind_checks(nb::module_& m);
void bind_log(nb::module_& m);
void bind_diagrams(nb::module_& m);
void bind_distributed(nb::module_& m);
void bind_out_of_core(nb::module_& m);
void bind_transport(nb::module_& m);
void bind_sampling(nb::module_& m);
void bind_remeshing(nb::module_& m);
void bind_treemaps(nb::module_& m);
void bind_files(nb::module_& m);
void bind_seeds_outside(nb::module_& m);

}  // namespace powercell::python
