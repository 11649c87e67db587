// Buffers of a call that share memory.
#include <doctest/doctest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "tests/device_diagram/caller.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr std::uint32_t n = 10;

/// Parts of one buffer.
class SubBuffers {
 public:
  SubBuffers(const Caller& caller, std::size_t bytes) : whole_(caller, bytes) {}
  ~SubBuffers() {
    for (const cl_mem part : parts_) clReleaseMemObject(part);
  }
  SubBuffers(const SubBuffers&) = delete;
  SubBuffers& operator=(const SubBuffers&) = delete;

  cl_mem whole() const { return whole_.handle(); }
  cl_mem part(std::size_t begin, std::size_t bytes) {
    const cl_buffer_region region{begin, bytes};
    cl_int status = CL_SUCCESS;
    parts_.push_back(clCreateSubBuffer(whole_.handle(), CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION,
                                       &region, &status));
    REQUIRE(status == CL_SUCCESS);
    return parts_.back();
  }

 private:
  Memory whole_;
  std::vector<cl_mem> parts_;
};

std::string refusal(DeviceDiagram& diagram, cl_mem positions, cl_mem weights, const DeviceResults& results) {
  try {
    diagram.enqueue(positions, weights, n, results);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    return error.what();
  }
  return {};
}

bool names(const std::string& text, const char* one, const char* other) {
  return text.find(one) != std::string::npos && text.find(other) != std::string::npos &&
         text.find("share memory") != std::string::npos;
}

}  // namespace

TEST_CASE("one buffer twice, where it is written") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  const std::size_t real = diagram.precision() == Precision::float64 ? 8 : 4;
  const std::vector<double> at = {.1, .2, .3, .4, .5, .6, .7, .8, .9, .1,
                                  .2, .3, .4, .5, .6, .7, .8, .9, .1, .2};
  const Reals seeds(caller, diagram.precision(), at);
  const Memory large(caller, 4000), measures(caller, 4 * n * real), status(caller, 4 * n),
      list(caller, 4 * n);
  const cl_mem p = large.handle(), m = measures.handle(), s = status.handle();
  CHECK(names(refusal(diagram, p, nullptr, {p, s}), "measures", "positions"));
  CHECK(names(refusal(diagram, p, nullptr, {m, p}), "status", "positions"));
  CHECK(names(refusal(diagram, seeds.handle(), p, {p, s}), "measures", "weights"));
  CHECK(names(refusal(diagram, seeds.handle(), nullptr, {p, p}), "measures", "status"));
  CHECK(names(refusal(diagram, seeds.handle(), nullptr, {m, s, {p, list.handle(), p}}), "offsets", "walls"));
  CHECK(names(refusal(diagram, p, nullptr, {m, s, {}, {p, list.handle()}}), "uncertain", "positions"));
  CHECK(names(refusal(diagram, seeds.handle(), nullptr, {m, s, {}, {list.handle(), s}}), "uncertain",
              "status"));
  // What is only read may be one.
  CHECK(refusal(diagram, seeds.handle(), seeds.handle(), {m, s}).empty());
  clFinish(caller.queue());
}

TEST_CASE("parts of one buffer") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  SubBuffers sub_buffers(caller, 1 << 16);
  constexpr std::size_t step = 4096;  // more than any device wants sub_buffers to be aligned to
  const Memory status(caller, 4 * n);
  const cl_mem first = sub_buffers.part(0, step), second = sub_buffers.part(step, step),
               both = sub_buffers.part(0, 2 * step), third = sub_buffers.part(2 * step, step),
               within = sub_buffers.part(step, 2 * step);
  CHECK(refusal(diagram, first, second, {third, status.handle()}).empty());
  CHECK(refusal(diagram, both, second, {third, status.handle()}).empty());  // both are read
  clFinish(caller.queue());
  CHECK(names(refusal(diagram, both, nullptr, {second, status.handle()}), "measures", "positions"));
  CHECK(names(refusal(diagram, first, third, {within, status.handle()}), "measures", "weights"));
  CHECK(names(refusal(diagram, first, nullptr, {second, sub_buffers.whole()}), "status", "share memory"));
  CHECK(names(refusal(diagram, second, first, {both, status.handle()}), "measures", "share memory"));
}

TEST_CASE("buffers in the same memory of the host") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  std::vector<std::byte> memory(1 << 16);
  const auto buffer = [&](std::size_t begin, std::size_t bytes) {
    cl_int status = CL_SUCCESS;
    const cl_mem made = clCreateBuffer(caller.context(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes,
                                       memory.data() + begin, &status);
    REQUIRE(status == CL_SUCCESS);
    return made;
  };
  const cl_mem first = buffer(0, 8192), second = buffer(4096, 8192), third = buffer(12288, 4096);
  const Memory status(caller, 4 * n);
  CHECK(refusal(diagram, first, nullptr, {third, status.handle()}).empty());
  clFinish(caller.queue());
  CHECK(names(refusal(diagram, first, nullptr, {second, status.handle()}), "measures", "positions"));
  for (const cl_mem made : {first, second, third}) clReleaseMemObject(made);
}
