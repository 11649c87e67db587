/// \file
/// A compiled program and its kernels.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>

#include "lib/cl/buffer.hpp"

namespace powercell::cl {

/// A built cl_program; immutable, shared.
class Program {
 public:
  Program(cl_program program, cl_device_id device) : program_(program), device_(device) {}  // takes ownership
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();
  cl_program handle() const { return program_; }
  cl_device_id device() const { return device_; }

  /// Runs `test`, unless it has succeeded before: whether the program computes a known answer on its device
  /// (lib/clip/golden.hpp). Other threads wait for it; where `test` itself calls this, nothing is done.
  void trust_after(const std::function<void()>& test) const;

 private:
  cl_program program_;
  cl_device_id device_;
  mutable std::atomic<bool> trusted_{false};
  mutable std::recursive_mutex testing_;
  mutable bool under_test_ = false;  // guarded by testing_
};

/// One kernel object: set arguments, launch. Not thread-safe; make one per call or per diagram.
///
///     kernel.args(count, positions, weights);  // the first three arguments
///     tree.append_arguments(kernel);           // calls kernel.more_args(...) for those that follow
///     kernel.launch(count);                    // throws unless the kernel has exactly as many
class Kernel {
 public:
  Kernel(std::shared_ptr<Context> context, std::shared_ptr<const Program> program, const std::string& name);
  Kernel(Kernel&&) noexcept;
  Kernel& operator=(Kernel&&) noexcept;
  ~Kernel();

  /// Sets the arguments in order from the first on: Buffer<T>, RawBuffer, cl_mem, or a plain scalar of the
  /// exact OpenCL type.
  template <class... Args>
  Kernel& args(const Args&... values) {
    arguments_set_ = 0;
    return more_args(values...);
  }
  /// Sets the arguments that follow the last one set.
  template <class... Args>
  Kernel& more_args(const Args&... values) {
    (set(arguments_set_++, values), ...);
    return *this;
  }
  /// Enqueues `global` work-items (rounded up to the group size; kernels guard their tail) and adds
  /// the event's device time to `seconds` when it is not null (waits for it then).
  /// local = 0 lets the class choose: a power of two within the queried limits of device and kernel.
  /// \throw Error internal unless the last argument set is the kernel's last; opencl, out_of_device_memory
  void launch(std::size_t global, std::size_t local = 0, double* seconds = nullptr);
  /// As launch(), on GPUs in parts that take a twentieth of a second each, for kernels whose work-items have
  /// nothing to do with their groups. Waits for the parts there.
  void launch_in_parts(std::size_t global);
  /// As launch() without waiting. On a caller's queue, which the caller may hold back, it does not wait where
  /// the driver compiles at the first launch either.
  /// \param done  the caller's to release, if not null
  void submit(std::size_t global, std::size_t local = 0, cl_event* done = nullptr);

 private:
  template <class T>
  void set(cl_uint index, const Buffer<T>& b) {
    set_memory(index, b.handle());
  }
  void set(cl_uint index, const RawBuffer& b) { set_memory(index, b.handle()); }
  void set(cl_uint index, cl_mem m) { set_memory(index, m); }
  template <class T>
  requires std::is_arithmetic_v<T>
  void set(cl_uint index, T value) { set_bytes(index, sizeof(T), &value); }
  void set_memory(cl_uint index, cl_mem memory);
  void set_bytes(cl_uint index, std::size_t size, const void* value);
  void require_all_arguments() const;
  std::size_t group_size();  ///< that the class chooses

  std::shared_ptr<Context> context_;
  std::shared_ptr<const Program> program_;
  cl_kernel kernel_ = nullptr;
  std::string name_;
  std::size_t group_size_ = 0;  // 0 until it is chosen
  cl_uint argument_count_ = 0;  // of the kernel
  cl_uint arguments_set_ = 0;   // in order, by the last calls of args() and more_args()
};

}  // namespace powercell::cl
