#include <doctest/doctest.h>

#include <numeric>

#include "lib/cl/program.hpp"
#include "tests/cl/support.hpp"
#include "tests/support/environment.hpp"

using namespace powercell;

namespace {

const char* const source = R"(
__kernel void mark(__global uint* out, uint count) {
  const uint i = get_global_id(0);
  if (i < count) out[i] += i + 1;
}
__kernel void group_size(__global uint* out) {
  if (get_global_id(0) == 0) out[0] = get_local_size(0);
}
__kernel __attribute__((reqd_work_group_size(8, 1, 1))) void group_size_8(__global uint* out) {
  if (get_global_id(0) == 0) out[0] = get_local_size(0);
}
)";

std::shared_ptr<const cl::Program> program() {
  return source_program(test_device().context(), source);
}

}  // namespace

TEST_CASE("a launch reaches every item once and none beyond") {
  auto context = test_device().context();
  cl::Kernel kernel(context, program(), "mark");
  for (const std::size_t count : {0u, 1u, 1000u, 4097u}) {
    for (const std::size_t local : {0u, 16u}) {
      CAPTURE(count);
      CAPTURE(local);
      cl::Buffer<cl_uint> out(context);
      out.resize(count + 1);
      out.zero();
      double seconds = 0;
      kernel.args(out, static_cast<cl_uint>(count)).launch(count, local, count == 1000 ? &seconds : nullptr);
      std::vector<cl_uint> expected(count + 1);
      std::iota(expected.begin(), expected.end(), 1u);
      expected[count] = 0;
      CHECK(out.download() == expected);
      CHECK((seconds > 0) == (count == 1000));
      CHECK(seconds < 10);
    }
  }
}

TEST_CASE("launches in parts reach every item once, on GPUs in parts that grow with their speed") {
  const std::string name = test_device().info().selector();
  for (const char* const treated_as : {"", "gpu"}) {
    CAPTURE(treated_as);
    const Environment treated("POWERCELL_TREAT_AS", treated_as);
    auto context = Device::choose(name).context();
    const auto program = source_program(context, source);
    cl::Kernel kernel(context, program, "mark");
    const std::size_t first = context->items_at_a_time(*program, "mark");
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, first + 1, 20 * first}) {
      CAPTURE(count);
      cl::Buffer<cl_uint> out(context);
      out.resize(count + 1);
      out.zero();
      kernel.args(out, static_cast<cl_uint>(count)).launch_in_parts(count);
      std::vector<cl_uint> expected(count + 1);
      std::iota(expected.begin(), expected.end(), 1u);
      expected[count] = 0;
      CHECK(out.download() == expected);
    }
    const std::size_t last = context->items_at_a_time(*program, "mark");
    CHECK((last > first) == (std::string(treated_as) == "gpu"));
  }
}

TEST_CASE("launches are as large as a wanted time permits") {
  cl::LaunchSize size(1);
  CHECK(size.items() == 1024);  // and not less
  size.took(1024, 1e-6);
  CHECK(size.items() == 4096);  // at most four times as many
  size.took(4096, 0.025);
  CHECK(size.items() == 8192);
  size.took(100, 0.001);  // few items are no measure of many
  CHECK(size.items() == 8192);
  size.took(4096, 0.1);  // unless they take long
  CHECK(size.items() == 2048);
  size.took(2048, 10);
  CHECK(size.items() == 1024);
  size.took(1024, 0);  // a clock that is too coarse
  CHECK(size.items() == 4096);
  for (int k = 0; k < 40; ++k) size.took(size.items(), 1e-9);
  CHECK(size.items() == std::size_t{1} << 30);
}

TEST_CASE("the chosen group size is a power of two within the limits, or what the kernel requires") {
  auto context = test_device().context();
  cl::Buffer<cl_uint> out(context);
  out.resize(1);
  cl::Kernel(context, program(), "group_size").args(out).launch(1000);
  const cl_uint chosen = out.download()[0];
  CHECK(chosen > 0);
  CHECK((chosen & (chosen - 1)) == 0);
  CHECK(chosen <= context->info().max_work_group_size);
  cl::Kernel(context, program(), "group_size_8").args(out).launch(1000);
  CHECK(out.download()[0] == 8);
}

TEST_CASE("what goes wrong with a kernel names the kernel") {
  auto context = test_device().context();
  auto message_of = [](auto&& call) {
    const auto error = error_of(call);
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::opencl);
    return std::string(error->what());
  };
  const std::string unknown = message_of([&] { cl::Kernel(context, program(), "teapot"); });
  CHECK(contains(unknown, "teapot"));
  CHECK(contains(unknown, "CL_INVALID_KERNEL_NAME"));

  cl::Kernel kernel(context, program(), "mark");
  cl::Buffer<cl_uint> out(context);
  out.resize(1);
  const std::string wrong_size = message_of([&] { kernel.args(out, cl_ulong{1}); });
  CHECK(contains(wrong_size, "argument 1 of the kernel mark"));
  const std::string too_large =
      message_of([&] { kernel.args(out, cl_uint{1}).launch(1, 2 * context->info().max_work_group_size); });
  CHECK(contains(too_large, "mark"));
}

TEST_CASE("arguments are appended in order, and a launch with too few or too many is refused") {
  auto context = test_device().context();
  cl::Buffer<cl_uint> out(context);
  out.upload(std::vector<cl_uint>{0});
  cl::Kernel kernel(context, program(), "mark");
  const auto refused = [&](auto&& launch, const char* set) {
    const auto error = error_of(launch);
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::internal);
    CHECK(contains(error->what(), "kernel mark has 2 arguments"));
    CHECK(contains(error->what(), set));
  };
  refused([&] { kernel.launch(1); }, "0 are set");
  refused([&] { kernel.args(out).submit(1); }, "1 are set");
  kernel.more_args(cl_uint{1}).launch(1);
  CHECK(out.download()[0] == 1);
  kernel.launch(1);  // with the same arguments
  CHECK(out.download()[0] == 2);
  refused([&] { kernel.args(out).launch(1); }, "1 are set");  // although OpenCL still holds the second one
  kernel.args(out, cl_uint{1});
  const auto beyond = error_of([&] { kernel.more_args(cl_uint{1}); });
  REQUIRE(beyond);
  CHECK(contains(beyond->what(), "CL_INVALID_ARG_INDEX"));
  CHECK(contains(beyond->what(), "argument 2 of the kernel mark"));
}

TEST_CASE("a moved kernel keeps its arguments") {
  auto context = test_device().context();
  cl::Buffer<cl_uint> out(context);
  out.upload(std::vector<cl_uint>{0});
  cl::Kernel from(context, program(), "mark");
  from.args(out, cl_uint{1});
  cl::Kernel to(std::move(from));
  to.launch(1);
  cl::Kernel other(context, program(), "group_size");
  other = std::move(to);
  other.launch(1);
  CHECK(out.download()[0] == 2);
}
