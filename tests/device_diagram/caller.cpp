#include "tests/device_diagram/caller.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/opencl.hpp>

#include "lib/cl/context.hpp"

namespace powercell::test {
namespace {

/// The values in a precision, as at least one byte.
std::vector<std::byte> packed(std::span<const double> values, Precision precision) {
  std::vector<float> narrow(values.begin(), values.end());
  const auto bytes =
      precision == Precision::float32 ? std::as_bytes(std::span<const float>(narrow)) : std::as_bytes(values);
  std::vector<std::byte> result(bytes.begin(), bytes.end());
  result.resize(std::max<std::size_t>(1, result.size()));
  return result;
}

/// The device chosen by the environment; lives until the process ends.
const Device& chosen_device() {
  static auto* device = new Device(Device::choose());
  return *device;
}

}  // namespace

Caller::Caller(cl_command_queue_properties properties) {
  const auto& shared = *chosen_device().context();
  const cl_device_id id = shared.device();
  fp64_ = shared.info().fp64;
  cl_int status = CL_SUCCESS;
  context_ = clCreateContext(nullptr, 1, &id, nullptr, nullptr, &status);
  REQUIRE(status == CL_SUCCESS);
  queue_ = clCreateCommandQueue(context_, id, properties, &status);
  REQUIRE(status == CL_SUCCESS);
}

Caller::~Caller() {
  device_.clear();
  clReleaseCommandQueue(queue_);
  clReleaseContext(context_);
}

const Device& Caller::device() {
  if (device_.empty()) device_.push_back(device_from_queue(queue_));
  return device_.front();
}

Caller& shared_caller() {
  static auto* made = new Caller;
  return *made;
}

std::vector<Precision> precisions(const Caller& caller) {
  if (caller.fp64()) return {Precision::float64, Precision::float32};
  return {Precision::float32};
}

Memory::Memory(const Caller& caller, std::size_t bytes, const void* values) {
  cl_int status = CL_SUCCESS;
  memory_ = clCreateBuffer(caller.context(), CL_MEM_READ_WRITE | (values ? CL_MEM_COPY_HOST_PTR : 0),
                           std::max<std::size_t>(1, bytes), const_cast<void*>(values), &status);
  REQUIRE(status == CL_SUCCESS);
}

Reals::Reals(const Caller& caller, Precision precision, std::span<const double> values)
    : precision_(precision),
      memory_(caller, values.size() * (precision == Precision::float32 ? sizeof(float) : sizeof(double)),
              packed(values, precision).data()) {}

void Reals::write(cl_command_queue queue, std::span<const double> values) const {
  const std::vector<std::byte> bytes = packed(values, precision_);
  REQUIRE(clEnqueueWriteBuffer(queue, memory_.handle(), CL_TRUE, 0, bytes.size(), bytes.data(), 0, nullptr,
                               nullptr) == CL_SUCCESS);
}

Rows::Rows(const Caller& caller, Precision precision, std::size_t n, std::size_t room, bool periodic)
    : caller_(caller),
      real_(precision == Precision::float32 ? sizeof(float) : sizeof(double)),
      n_(n),
      room_(room),
      periodic_(periodic),
      marks_(std::max<std::size_t>(room, 1), unwritten),
      offset_(caller, (n + 1) * sizeof(cl_uint)),
      neighbor_(caller, marks_.size() * sizeof(cl_uint), marks_.data()),
      wall_(caller, marks_.size() * real_),
      shift_(caller, marks_.size() * 3 * sizeof(cl_int)) {}

Adjacency Rows::read() const {
  const std::vector<cl_uint> offset = offset_.values<cl_uint>(caller_.queue(), n_ + 1);
  Adjacency rows;
  rows.offset.assign(offset.begin(), offset.end());
  const std::size_t written = std::min<std::size_t>(offset.back(), room_);
  rows.neighbor = neighbor_.values<cl_uint>(caller_.queue(), written);
  if (real_ == sizeof(double)) {
    rows.wall = wall_.values<double>(caller_.queue(), written);
  } else {
    const std::vector<float> narrow = wall_.values<float>(caller_.queue(), written);
    rows.wall.assign(narrow.begin(), narrow.end());
  }
  if (periodic_) rows.shift = shift_.values<std::array<std::int32_t, 3>>(caller_.queue(), written);
  return rows;
}

BoundaryRows::BoundaryRows(const Caller& caller, Precision precision, std::size_t n, std::size_t room)
    : caller_(caller),
      precision_(precision),
      n_(n),
      room_(room),
      marks_(std::max<std::size_t>(room, 1), unwritten),
      offset_(caller, (n + 1) * sizeof(cl_uint)),
      facet_(caller, marks_.size() * sizeof(cl_uint), marks_.data()),
      measure_(caller, marks_.size() * (precision == Precision::float32 ? sizeof(float) : sizeof(double))) {}

BoundaryWalls BoundaryRows::read() const {
  const cl_command_queue queue = caller_.queue();
  const std::vector<cl_uint> offset = offset_.values<cl_uint>(queue, n_ + 1);
  BoundaryWalls walls;
  walls.offset.assign(offset.begin(), offset.end());
  const std::size_t written = std::min<std::size_t>(offset.back(), room_);
  walls.facet = facet_.values<cl_uint>(queue, written);
  if (precision_ == Precision::float32) {
    const std::vector<float> narrow = measure_.values<float>(queue, written);
    walls.measure.assign(narrow.begin(), narrow.end());
  } else {
    walls.measure = measure_.values<double>(queue, written);
  }
  return walls;
}

double Output::total() const {
  return std::accumulate(mass.begin(), mass.end(), 0.0);
}

std::size_t Output::count(DeviceSeedStatus s) const {
  return static_cast<std::size_t>(std::count(status.begin(), status.end(), s));
}

Job::Job(const Caller& caller, Precision precision, const SeedsView& seeds, bool weighted)
    : caller_(caller),
      precision_(precision),
      dimension_(static_cast<std::size_t>(seeds.dimension)),
      count_(seeds.size()),
      real_(precision == Precision::float32 ? sizeof(float) : sizeof(double)),
      weighted_(weighted),
      positions_(caller, count_ * dimension_ * real_, packed(seeds.positions, precision).data()),
      weights_(caller, seeds.weights.size() * real_, packed(seeds.weights, precision).data()),
      measures_(caller, count_ * (2 + dimension_) * real_),
      status_(caller, count_ * sizeof(cl_uint)) {}

void Job::enqueue(DeviceDiagram& diagram, cl_uint wait_count, const cl_event* wait_list,
                  cl_event* done) const {
  diagram.enqueue(positions_.handle(), weighted_ ? weights_.handle() : nullptr,
                  static_cast<std::uint32_t>(count_), measures_.handle(), status_.handle(), wait_count,
                  wait_list, done);
}

void Job::enqueue(DeviceDiagram& diagram, const Wanted& wanted) const {
  diagram.enqueue(positions_.handle(), weighted_ ? weights_.handle() : nullptr,
                  static_cast<std::uint32_t>(count_), results(wanted));
}

std::uint32_t Job::repair(DeviceDiagram& diagram, const Wanted& wanted) const {
  return diagram.repair(positions_.handle(), weighted_ ? weights_.handle() : nullptr,
                        static_cast<std::uint32_t>(count_), results(wanted));
}

Output Job::read() const {
  Output output;
  const std::size_t columns = 2 + dimension_, entries = count_ * columns;
  std::vector<double> measures(entries);
  std::vector<float> narrow(entries);
  std::vector<cl_uint> status(count_);
  if (count_ > 0) {
    void* to = precision_ == Precision::float32 ? static_cast<void*>(narrow.data()) : measures.data();
    REQUIRE(clEnqueueReadBuffer(caller_.queue(), measures_.handle(), CL_TRUE, 0, entries * real_, to, 0,
                                nullptr, nullptr) == CL_SUCCESS);
    REQUIRE(clEnqueueReadBuffer(caller_.queue(), status_.handle(), CL_TRUE, 0, count_ * sizeof(cl_uint),
                                status.data(), 0, nullptr, nullptr) == CL_SUCCESS);
  }
  if (precision_ == Precision::float32) measures.assign(narrow.begin(), narrow.end());
  for (std::size_t i = 0; i < count_; ++i) {
    const double* row = &measures[i * columns];
    output.mass.push_back(row[0]);
    output.centroid.insert(output.centroid.end(), row + 1, row + 1 + dimension_);
    output.second_moment.push_back(row[1 + dimension_]);
    output.status.push_back(static_cast<DeviceSeedStatus>(status[i]));
  }
  return output;
}

Output run(Caller& caller, DeviceDiagram& diagram, const SeedsView& seeds, bool weighted) {
  const Job job(caller, diagram.precision(), seeds, weighted);
  job.enqueue(diagram);
  return job.read();
}

std::vector<double> rounded(std::span<const double> values, Precision precision) {
  std::vector<double> result(values.begin(), values.end());
  if (precision == Precision::float32)
    for (double& x : result) x = static_cast<float>(x);
  return result;
}

SeedArray rounded_seeds(SeedArray seeds, Precision precision) {
  seeds.positions = rounded(seeds.positions, precision);
  seeds.weights = rounded(seeds.weights, precision);
  return seeds;
}

double tolerance(Precision precision) {
  return precision == Precision::float64 ? 1e-11 : 2e-4;
}

double wall_tolerance(const Domain& domain, Precision precision) {
  const int d = domain.cell_dimension();
  return std::pow(domain.measure(), (d - 1.0) / d) * (precision == Precision::float64 ? 1e-9 : 1e-3);
}

}  // namespace powercell::test
