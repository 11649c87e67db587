#include <doctest/doctest.h>

#include <chrono>
#include <powercell/opencl.hpp>
#include <thread>

#include "lib/cl/enumerate.hpp"
#include "lib/cl/program.hpp"
#include "tests/cl/support.hpp"

using namespace powercell;

namespace {

/// OpenCL objects as a caller would have them.
struct Caller {
  explicit Caller(cl_command_queue_properties properties) {
    const auto found = cl::find_devices().usable;
    REQUIRE_FALSE(found.empty());
    info = found[0].info;
    cl_int status = CL_SUCCESS;
    context = clCreateContext(nullptr, 1, &found[0].device, nullptr, nullptr, &status);
    REQUIRE(status == CL_SUCCESS);
    queue = clCreateCommandQueue(context, found[0].device, properties, &queue_status);
  }
  ~Caller() {
    if (queue) clReleaseCommandQueue(queue);
    clReleaseContext(context);
  }
  cl_uint queue_references() const {
    cl_uint count = 0;
    clGetCommandQueueInfo(queue, CL_QUEUE_REFERENCE_COUNT, sizeof count, &count, nullptr);
    return count;
  }
  /// Drivers let go of finished commands, and of the queue with them, in threads of their own: the count once
  /// it is `expected`, or whatever it is after ten seconds.
  cl_uint references_settled_at(cl_uint expected) const {
    for (int k = 0; k < 1000 && queue_references() != expected; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return queue_references();
  }
  DeviceInfo info;
  cl_context context = nullptr;
  cl_command_queue queue = nullptr;
  cl_int queue_status = CL_SUCCESS;
};

}  // namespace

TEST_CASE("a device from the caller's queue works in the caller's context and lets go of it") {
  Caller caller(0);
  REQUIRE(caller.queue);
  const cl_uint before = caller.queue_references();
  {
    const Device device = device_from_queue(caller.queue);
    CHECK(caller.references_settled_at(before + 1) == before + 1);
    CHECK(device.context()->context() == caller.context);
    CHECK(device.context()->queue() == caller.queue);
    CHECK(device.info().selector() == caller.info.selector());
    CHECK(device.info().name == caller.info.name);

    // The queue does not profile: time comes from the clock.
    auto context = device.context();
    const char* source = "__kernel void one(__global uint* out) { out[get_global_id(0)] = 1; }";
    cl::Kernel kernel(context, source_program(context, source), "one");
    cl::Buffer<cl_uint> out(context);
    out.resize(64);
    double seconds = 0;
    kernel.args(out).launch(64, 64, &seconds);
    CHECK(seconds > 0);
    CHECK(out.download() == std::vector<cl_uint>(64, 1));
  }
  CHECK(caller.references_settled_at(before) == before);
}

TEST_CASE("queues that cannot be used are refused") {
  const auto null = error_of([] { device_from_queue(nullptr); });
  REQUIRE(null);
  CHECK(null->code() == ErrorCode::invalid_argument);

  Caller caller(CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
  if (caller.queue_status != CL_SUCCESS) {
    MESSAGE("this device has no out-of-order queues");
    return;
  }
  const cl_uint before = caller.queue_references();
  const auto out_of_order = error_of([&] { device_from_queue(caller.queue); });
  REQUIRE(out_of_order);
  CHECK(out_of_order->code() == ErrorCode::invalid_argument);
  CHECK(contains(out_of_order->what(), "out of order"));
  CHECK(caller.references_settled_at(before) == before);
}
