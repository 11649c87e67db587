#include <algorithm>
#include <powercell/opencl.hpp>
#include <powercell/seeds.hpp>

#include "lib/diagram/device_diagram.hpp"

namespace powercell {
namespace {

template <class T>
T memory_value(cl_mem memory, cl_mem_info which, const char* name) {
  T value{};
  cl::check(clGetMemObjectInfo(memory, which, sizeof value, &value, nullptr),
            std::string("asking the caller's buffer of ") + name + " for a property");
  return value;
}

/// \throw Error invalid_argument unless the caller's buffer exists, belongs to the device's context and has
///        at least `bytes` bytes
void require_buffer(const cl::Context& context, cl_mem memory, std::size_t bytes, const char* name) {
  if (!memory) throw Error(ErrorCode::invalid_argument, std::string("the buffer of ") + name + " is null");
  if (memory_value<cl_context>(memory, CL_MEM_CONTEXT, name) != context.context())
    throw Error(ErrorCode::invalid_argument,
                std::string("the buffer of ") + name +
                    " belongs to another context than the device's queue; make the device "
                    "with device_from_queue on a queue of the buffer's context");
  const auto size = memory_value<std::size_t>(memory, CL_MEM_SIZE, name);
  if (size < bytes)
    throw Error(ErrorCode::invalid_argument, std::string("the buffer of ") + name + " has " +
                                                 std::to_string(size) + " bytes; it needs " +
                                                 std::to_string(bytes));
}

}  // namespace

DeviceDiagram::DeviceDiagram(Device device, Domain domain, Options options) {
  if (domain.is_periodic())
    throw Error(
        ErrorCode::unsupported,
        "a diagram in device memory has no periodic domain, because the images of seeds are found on the "
        "host; use Diagram");
  if (options.neighbors == Neighbors::flann)
    throw Error(ErrorCode::unsupported,
                "FLANN makes neighbour lists on the host, so a diagram in device memory cannot use them; use "
                "Neighbors::tree, or Diagram");
  state_ = std::make_unique<State>(std::move(device), std::move(domain), std::move(options));
}
DeviceDiagram::DeviceDiagram(DeviceDiagram&&) noexcept = default;
DeviceDiagram& DeviceDiagram::operator=(DeviceDiagram&&) noexcept = default;
DeviceDiagram::~DeviceDiagram() = default;

const Device& DeviceDiagram::device() const {
  return state_->device;
}
const Domain& DeviceDiagram::domain() const {
  return state_->domain;
}
Precision DeviceDiagram::precision() const {
  return state_->precision;
}

void DeviceDiagram::set_pair_capacity(std::uint32_t pairs) {
  state_->pair_capacity = pairs;
}

void DeviceDiagram::enqueue(cl_mem positions, cl_mem weights, std::uint32_t n, cl_mem measures, cl_mem status,
                            cl_uint wait_count, const cl_event* wait_list, cl_event* done) {
  State& s = *state_;
  const cl::Context& context = *s.device.context();
  if (n > most_seeds_of_diagram)
    throw Error(ErrorCode::invalid_argument, std::to_string(n) + " seeds are more than the " +
                                                 std::to_string(most_seeds_of_diagram) +
                                                 " that one diagram can have");
  if (n > 0) {
    const std::size_t real = s.precision == Precision::float32 ? sizeof(float) : sizeof(double);
    const auto d = static_cast<std::size_t>(s.domain.dimension());
    require_buffer(context, positions, n * d * real, "positions");
    if (weights) require_buffer(context, weights, n * real, "weights");
    require_buffer(context, measures, n * (2 + d) * real, "measures");
    require_buffer(context, status, n * sizeof(cl_uint), "status");
  }
  // The queue is in order, so all later commands wait for the caller's events too.
  if (wait_count > 0)
    cl::check(clEnqueueBarrierWithWaitList(context.queue(), wait_count, wait_list, nullptr),
              "enqueueing a barrier for the caller's events");
  if (n > 0)
    s.enqueue(positions, weights, n, measures, status, done);
  else if (done)
    cl::check(clEnqueueMarkerWithWaitList(context.queue(), 0, nullptr, done), "enqueueing a marker");
  const cl_int flushed = clFlush(context.queue());
  if (flushed != CL_SUCCESS && done) {  // callers get no event with an exception
    clReleaseEvent(*done);
    *done = nullptr;
  }
  cl::check(flushed, "flushing the caller's queue");
}

}  // namespace powercell
