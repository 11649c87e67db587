/// \file
/// Calls of the library from Python: without the interpreter's lock, and with Ctrl-C, the caller's functions
/// and their exceptions.
#pragma once

#include <exception>
#include <mutex>

#include "python/src/arrays.hpp"

namespace powercell::python {

/// \throw Error unsupported in a process that was forked after a device was opened: the OpenCL runtime's
/// threads are not there
void require_same_process();

/// One call. Functions that run within it report exceptions of Python, which come out of run() unchanged.
class Call {
 public:
  /// \param progress  None, or a function of what is reported, which may return False to stop
  explicit Call(nb::object progress) : progress_(std::move(progress)) {}

  /// Runs `function` without the interpreter's lock.
  template <class Function>
  auto run(const Function& function) {
    require_same_process();
    try {
      const nb::gil_scoped_release released;
      return function();
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

  /// Runs a function of Python from any thread. \return false if it threw, now or before
  template <class Function>
  bool python(const Function& function) {
    const nb::gil_scoped_acquire acquired;
    if (exception_) return false;
    try {
      function();
      return true;
    } catch (...) {
      exception_ = std::current_exception();
      return false;
    }
  }

 private:
  static void throw_if_interrupted() {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }

  nb::object progress_;
  std::exception_ptr exception_;  // guarded by the interpreter's lock
};

/// What an object of the library that keeps its callbacks is called with: the call that is running.
/// Calls from several threads wait for each other.
class CallSlot {
 public:
  template <class Function>
  auto run(nb::object progress, const Function& function) {
    Call call(std::move(progress));
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
void bind_diagrams(nb::module_& m);
void bind_transport(nb::module_& m);
void bind_sampling(nb::module_& m);
void bind_remeshing(nb::module_& m);
void bind_treemaps(nb::module_& m);
void bind_files(nb::module_& m);

}  // namespace powercell::python
