#include <doctest/doctest.h>

#include <numeric>

#include "lib/cl/program.hpp"
#include "tests/cl/support.hpp"

using namespace powercell;

TEST_CASE("a launch reaches every item once and none beyond") {
  auto context = test_device().context();
  cl::Kernel kernel(context, source_program(context, R"(
    __kernel void mark(__global uint* out, uint count) {
      const uint i = get_global_id(0);
      if (i < count) out[i] += i + 1;
    })"),
                    "mark");
  for (const std::size_t count : {0u, 1u, 1000u, 4097u}) {
    for (const std::size_t local : {0u, 16u}) {
      CAPTURE(count);
      CAPTURE(local);
      cl::Buffer<cl_uint> out(context);
      out.resize(count + 1);
      out.zero();
      kernel.args(out, static_cast<cl_uint>(count)).launch(count, local);
      std::vector<cl_uint> expected(count + 1);
      std::iota(expected.begin(), expected.end(), 1u);
      expected[count] = 0;
      CHECK(out.download() == expected);
    }
  }
}
