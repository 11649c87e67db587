/// \file
/// OpenCL objects of a caller of the library.
#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <doctest/doctest.h>

#include <cstdint>
#include <powercell/opencl.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <span>
#include <vector>

#include "tests/support/generators.hpp"

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

/// One for all cases, so that each program is built once. Lives until the process ends.
Caller& shared_caller();

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
  /// The first `count` values. Waits for the queue.
  template <class T>
  std::vector<T> values(cl_command_queue queue, std::size_t count) const {
    std::vector<T> to(count);
    if (count > 0)
      REQUIRE(clEnqueueReadBuffer(queue, memory_, CL_TRUE, 0, count * sizeof(T), to.data(), 0, nullptr,
                                  nullptr) == CL_SUCCESS);
    return to;
  }

 private:
  cl_mem memory_ = nullptr;
};

/// Reals of a precision in a buffer of the caller.
class Reals {
 public:
  Reals(const Caller& caller, Precision precision, std::span<const double> values);
  cl_mem handle() const { return memory_.handle(); }
  /// Writes others over them, without waiting for anything but the write.
  void write(cl_command_queue queue, std::span<const double> values) const;

 private:
  Precision precision_;
  Memory memory_;
};

/// The results, in double.
struct Output {
  std::vector<double> mass, centroid, second_moment;
  std::vector<DeviceSeedStatus> status;
  double total() const;
  std::size_t count(DeviceSeedStatus s) const;
};

/// Rows in device memory with room for `room` entries.
class Rows {
 public:
  /// \param periodic  with shifts
  Rows(const Caller& caller, Precision precision, std::size_t n, std::size_t room, bool periodic = false);
  static constexpr cl_uint unwritten = 0xfffffff0u;
  DeviceAdjacency handles() const {
    return {offset_.handle(), neighbor_.handle(), wall_.handle(), periodic_ ? shift_.handle() : nullptr};
  }
  /// Waits. Entries beyond the room are missing.
  Adjacency read() const;

 private:
  const Caller& caller_;
  std::size_t real_, n_, room_;
  bool periodic_;
  std::vector<cl_uint> marks_;
  Memory offset_, neighbor_, wall_, shift_;
};

/// Boundary walls in device memory with room for `room` entries.
class BoundaryRows {
 public:
  BoundaryRows(const Caller& caller, Precision precision, std::size_t n, std::size_t room);
  static constexpr cl_uint unwritten = 0xfffffff0u;
  DeviceBoundaryWalls handles() const { return {offset_.handle(), facet_.handle(), measure_.handle()}; }
  /// Waits. Entries beyond the room are missing.
  BoundaryWalls read() const;

 private:
  const Caller& caller_;
  Precision precision_;
  std::size_t n_, room_;
  std::vector<cl_uint> marks_;
  Memory offset_, facet_, measure_;
};

/// A list of uncertain seeds in device memory.
class List {
 public:
  List(const Caller& caller, std::size_t room)
      : caller_(caller), count_(caller, sizeof(cl_uint)), seeds_(caller, room * sizeof(cl_uint)) {}
  DeviceUncertain handles() const { return {count_.handle(), seeds_.handle()}; }
  std::uint32_t count() const { return count_.values<cl_uint>(caller_.queue(), 1)[0]; }
  /// The first `some` entries. Waits.
  std::vector<std::uint32_t> read(std::size_t some) const {
    return seeds_.values<cl_uint>(caller_.queue(), some);
  }
  std::vector<std::uint32_t> read() const { return read(count()); }

 private:
  const Caller& caller_;
  Memory count_, seeds_;
};

/// What is wanted beside measures and statuses.
struct Wanted {
  DeviceAdjacency adjacency = {};
  DeviceUncertain uncertain = {};
  DeviceCells cells = {};
  DeviceBoundaryWalls boundary_walls = {};
};

/// Seeds and results of one call in device memory.
class Job {
 public:
  /// \param seeds  rounded to the precision
  Job(const Caller& caller, Precision precision, const SeedsView& seeds, bool weighted = true);
  void enqueue(DeviceDiagram& diagram, cl_uint wait_count = 0, const cl_event* wait_list = nullptr,
               cl_event* done = nullptr) const;
  void enqueue(DeviceDiagram& diagram, const Wanted& wanted) const;
  std::uint32_t repair(DeviceDiagram& diagram, const Wanted& wanted) const;
  /// Waits for the queue.
  Output read() const;

 private:
  DeviceResults results(const Wanted& wanted) const {
    return {measures_.handle(), status_.handle(), wanted.adjacency,
            wanted.uncertain,   wanted.cells,     wanted.boundary_walls};
  }

  const Caller& caller_;
  Precision precision_;
  std::size_t dimension_, count_, real_;
  bool weighted_;
  Memory positions_, weights_, measures_, status_;
};

Output run(Caller& caller, DeviceDiagram& diagram, const SeedsView& seeds, bool weighted = true);

/// The values rounded to a precision.
std::vector<double> rounded(std::span<const double> values, Precision precision);
SeedArray rounded_seeds(SeedArray seeds, Precision precision);

/// Relative to the mean mass and to the domain's size: the cells are cut in another order.
double tolerance(Precision precision);
/// Of the measure of a wall, in the units of the domain.
double wall_tolerance(const Domain& domain, Precision precision);

}  // namespace powercell::test
