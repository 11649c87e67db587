// DeviceDiagram in a queue of the tool's own, as its callers have it.
#include <fmt/format.h>

#include <optional>
#include <powercell/opencl.hpp>

#include "apps/bench/timing.hpp"
#include "apps/report.hpp"
#include "apps/tune/job.hpp"

// Those that the library calls, so that the tool starts where there is no OpenCL.
#define OPENCL(name) (reinterpret_cast<decltype(&(name))>(opencl_function(#name)))

namespace powercell::app {
namespace {

void check(cl_int status, const char* doing) {
  if (status != CL_SUCCESS) throw Error(ErrorCode::opencl, fmt::format("{}: OpenCL error {}", doing, status));
}

cl_device_id find_device(const DeviceInfo& info) {
  std::vector<cl_platform_id> platforms(static_cast<std::size_t>(info.platform) + 1);
  check(OPENCL(clGetPlatformIDs)(static_cast<cl_uint>(platforms.size()), platforms.data(), nullptr),
        "listing platforms");
  std::vector<cl_device_id> found(static_cast<std::size_t>(info.device) + 1);
  check(OPENCL(clGetDeviceIDs)(platforms.back(), CL_DEVICE_TYPE_ALL, static_cast<cl_uint>(found.size()),
                               found.data(), nullptr),
        "listing devices");
  return found.back();
}

/// A context with a queue and buffers, released at the end.
class Queue {
 public:
  explicit Queue(cl_device_id device) {
    cl_int status = CL_SUCCESS;
    context_ = OPENCL(clCreateContext)(nullptr, 1, &device, nullptr, nullptr, &status);
    check(status, "creating a context");
    queue_ = OPENCL(clCreateCommandQueue)(context_, device, CL_QUEUE_PROFILING_ENABLE, &status);
    if (status != CL_SUCCESS) OPENCL(clReleaseContext)(context_);
    check(status, "creating a queue");
  }
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;
  ~Queue() {
    for (const cl_mem buffer : buffers_) OPENCL(clReleaseMemObject)(buffer);
    OPENCL(clReleaseCommandQueue)(queue_);
    OPENCL(clReleaseContext)(context_);
  }

  cl_command_queue handle() const { return queue_; }
  /// A buffer of `bytes`, with a copy of `from` unless that is null.
  cl_mem buffer(std::size_t bytes, const void* from) {
    cl_int status = CL_SUCCESS;
    const cl_mem_flags copy = from ? CL_MEM_COPY_HOST_PTR : 0;
    buffers_.push_back(
        OPENCL(clCreateBuffer)(context_, CL_MEM_READ_WRITE | copy, bytes, const_cast<void*>(from), &status));
    if (status != CL_SUCCESS) buffers_.pop_back();
    check(status, "creating a buffer");
    return buffers_.back();
  }
  void finish() const { check(OPENCL(clFinish)(queue_), "waiting for the device"); }
  void read(cl_mem from, std::size_t bytes, void* to) const {
    check(OPENCL(clEnqueueReadBuffer)(queue_, from, CL_TRUE, 0, bytes, to, 0, nullptr, nullptr),
          "reading measures");
  }

 private:
  cl_context context_ = nullptr;
  cl_command_queue queue_ = nullptr;
  std::vector<cl_mem> buffers_;
};

template <class Real>
class DeviceRun : public TunedRun {
 public:
  DeviceRun(const TuneJob& job, const DeviceInfo& info, const DeviceSettings& settings)
      : job_(job), columns_(2 + static_cast<std::size_t>(job.domain.dimension())), queue_(find_device(info)) {
    const std::vector<Real> positions(job.seeds.positions.begin(), job.seeds.positions.end()),
        weights(job.seeds.weights.begin(), job.seeds.weights.end());
    positions_ = queue_.buffer(positions.size() * sizeof(Real), positions.data());
    weights_ = queue_.buffer(weights.size() * sizeof(Real), weights.data());
    measures_ = queue_.buffer(size() * columns_ * sizeof(Real), nullptr);
    status_ = queue_.buffer(size() * sizeof(cl_uint), nullptr);
    const Device device = device_from_queue(queue_.handle());
    use_settings(device, settings);
    Options options;
    options.precision = job.precision;
    diagram_.emplace(device, job.domain, options);
  }

  double time() override {
    const double built = diagram_->device().build_seconds();
    Stopwatch watch;
    diagram_->enqueue(positions_, weights_, static_cast<std::uint32_t>(size()), measures_, status_);
    queue_.finish();
    return watch.lap() - (diagram_->device().build_seconds() - built);
  }

  std::vector<double> measures() const override {
    std::vector<Real> rows(size() * columns_);
    queue_.read(measures_, rows.size() * sizeof(Real), rows.data());
    return {rows.begin(), rows.end()};
  }

 private:
  std::size_t size() const { return job_.seeds.weights.size(); }

  const TuneJob& job_;
  const std::size_t columns_;
  Queue queue_;
  cl_mem positions_, weights_, measures_, status_;
  std::optional<DeviceDiagram> diagram_;
};

}  // namespace

std::unique_ptr<TunedRun> start_in_device_memory(const TuneJob& job, const DeviceInfo& info,
                                                 const DeviceSettings& settings) {
  if (job.precision == Precision::float32) return std::make_unique<DeviceRun<float>>(job, info, settings);
  return std::make_unique<DeviceRun<double>>(job, info, settings);
}

}  // namespace powercell::app
