/// \file
/// OpenCL objects of a caller of the library.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <powercell/opencl.hpp>
#include <powercell/seeds.hpp>
#include <vector>

namespace powercell::test {

/// A context and an in-order queue on the device that the environment chooses.
class Caller {
 public:
  explicit Caller(cl_command_queue_properties properties = 0);
  ~Caller();
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;

  bool fp64() const { return fp64_; }
  cl_context context() const { return context_; }
  cl_command_queue queue() const { return queue_; }
  /// The device of this queue; made once.
  const Device& device();

 private:
  bool fp64_ = false;
  cl_context context_ = nullptr;
  cl_command_queue queue_ = nullptr;
  std::vector<Device> device_;
};

/// Those that the device computes in.
std::vector<Precision> precisions(const Caller& caller);

/// A buffer of the caller.
class Memory {
 public:
  Memory(const Caller& caller, std::size_t bytes, const void* values = nullptr);
  ~Memory() { clReleaseMemObject(memory_); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  cl_mem handle() const { return memory_; }

 private:
  cl_mem memory_ = nullptr;
};

/// The results, in double.
struct Output {
  std::vector<double> mass, centroid, second_moment;
  std::vector<DeviceSeedStatus> status;
  double total() const;
  std::size_t count(DeviceSeedStatus s) const;
};

/// Seeds and results of one call in device memory.
class Job {
 public:
  /// \param seeds  rounded to the precision
  Job(const Caller& caller, Precision precision, const SeedsView& seeds, bool weighted = true);
  void enqueue(DeviceDiagram& diagram, cl_uint wait_count = 0, const cl_event* wait_list = nullptr,
               cl_event* done = nullptr) const;
  void enqueue(DeviceDiagram& diagram, const DeviceAdjacency& adjacency) const;
  /// Waits for the queue.
  Output read() const;

 private:
  const Caller& caller_;
  Precision precision_;
  std::size_t dimension_, count_, real_;
  bool weighted_;
  Memory positions_, weights_, measures_, status_;
};

Output run(Caller& caller, DeviceDiagram& diagram, const SeedsView& seeds, bool weighted = true);

/// The values rounded to a precision.
std::vector<double> rounded(std::span<const double> values, Precision precision);

}  // namespace powercell::test
