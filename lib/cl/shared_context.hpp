/// \file
/// A context of OpenCL and the programs built in it for one device. All Contexts of the process on the same
/// one share it, so that each program is built and tested once.
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>

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

}  // namespace powercell::cl
