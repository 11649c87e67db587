#include <doctest/doctest.h>

#include <numeric>

#include "lib/cl/buffer.hpp"
#include "tests/cl/support.hpp"

using namespace powercell;

TEST_CASE("what is uploaded comes back, whole or from an offset") {
  cl::Buffer<double> buffer(test_device().context());
  std::vector<double> values(1000);
  std::iota(values.begin(), values.end(), 0.5);
  buffer.upload(values);
  CHECK(buffer.size() == 1000);
  CHECK(buffer.download() == values);
  std::vector<double> part(10);
  buffer.download(part, 990);
  CHECK(part == std::vector<double>(values.end() - 10, values.end()));
  buffer.upload(std::span(values).first(3));
  CHECK(buffer.download() == std::vector<double>{0.5, 1.5, 2.5});
}

TEST_CASE("a buffer grows when asked and never shrinks") {
  cl::RawBuffer buffer(test_device().context());
  CHECK(buffer.handle() == nullptr);
  buffer.reserve(0);  // still an argument a kernel can take
  CHECK(buffer.handle() != nullptr);
  buffer.reserve(1000);
  const cl_mem memory = buffer.handle();
  buffer.reserve(10);
  CHECK(buffer.handle() == memory);
  CHECK(buffer.bytes() == 1000);
  buffer.reserve(100000);
  CHECK(buffer.bytes() == 100000);
  const char text[] = "offset";
  buffer.write(text, sizeof text, 99990);
  char back[sizeof text] = {};
  buffer.read(back, sizeof back, 99990);
  CHECK(std::string(back) == text);
}

TEST_CASE("clearing clears what was asked, at any size") {
  for (const std::size_t bytes : {1u, 3u, 4u, 12u, 16u, 4096u, 4097u}) {
    CAPTURE(bytes);
    cl::Buffer<unsigned char> buffer(test_device().context());
    buffer.upload(std::vector<unsigned char>(bytes + 1, 7));
    cl::RawBuffer raw(test_device().context());
    raw.reserve(bytes + 1);
    const std::vector<unsigned char> sevens(bytes + 1, 7);
    raw.write(sevens.data(), sevens.size());
    raw.fill_zero(bytes);
    std::vector<unsigned char> expected(bytes + 1, 0), got(bytes + 1);
    expected.back() = 7;
    raw.read(got.data(), got.size());
    CHECK(got == expected);
  }
}

TEST_CASE("a moved buffer takes its memory along") {
  cl::RawBuffer from(test_device().context());
  from.reserve(64);
  const cl_mem memory = from.handle();
  cl::RawBuffer to(std::move(from));
  CHECK(to.handle() == memory);
  CHECK(from.handle() == nullptr);  // NOLINT(bugprone-use-after-move): that is the question
  cl::RawBuffer other(test_device().context());
  other.reserve(8);
  other = std::move(to);
  CHECK(other.handle() == memory);
  CHECK(other.bytes() == 64);
}

TEST_CASE("an allocation beyond the device's largest is refused with both sizes") {
  const auto& info = test_device().info();
  cl::RawBuffer buffer(test_device().context());
  buffer.reserve(32);
  const auto error = error_of([&] { buffer.reserve(info.largest_allocation + 1); });
  REQUIRE(error);
  CHECK(error->code() == ErrorCode::out_of_device_memory);
  CHECK(contains(error->what(), std::to_string(info.largest_allocation)));
  CHECK(contains(error->what(), std::to_string(info.largest_allocation + 1)));
  CHECK(contains(error->what(), info.name));
  CHECK(buffer.bytes() == 32);  // what was there can still be used
  buffer.fill_zero(32);
}

TEST_CASE("access outside a buffer is caught before it reaches the driver") {
  cl::RawBuffer buffer(test_device().context());
  buffer.reserve(100);
  char byte = 0;
  for (const std::size_t offset : {std::size_t{100}, std::size_t{101}, SIZE_MAX}) {
    const auto error = error_of([&] { buffer.read(&byte, 1, offset); });
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::internal);
  }
}
