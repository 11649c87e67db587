// A wait for a transfer that fails is an error, and nothing is lost.
#include <doctest/doctest.h>

#include <vector>

#include "lib/cl/buffer.hpp"
#include "tests/support/opencl_shim.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Words = std::vector<std::uint32_t>;

Words words(std::uint32_t first) {
  Words all(1000);
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = first + static_cast<std::uint32_t>(k);
  return all;
}

void check_fails(const std::function<void()>& call) {
  shim::fail(shim::Entry::clWaitForEvents, 1, CL_OUT_OF_RESOURCES);
  CHECK_THROWS_AS(call(), Error);
  CHECK(shim::fired());
  shim::behave();
}

}  // namespace

TEST_CASE("a failed wait for a write or for reads is an error, after which both work") {
  const shim::Scope scope;
  const auto context = main_setups().front().device.context();
  cl::Buffer<std::uint32_t> buffer(context);
  buffer.upload(words(1));
  check_fails([&] { buffer.upload(words(2)); });
  buffer.upload(words(3));
  Words found(1000), again(1000);
  {
    cl::Reads reads(context);
    reads.add(buffer.raw(), found.data(), found.size() * sizeof found[0]);
    check_fails([&] { reads.wait(); });
    reads.wait();
  }
  CHECK(found == words(3));
  {
    cl::Reads reads(context);
    reads.add(buffer.raw(), again.data(), again.size() * sizeof again[0]);
  }  // waits
  CHECK(again == words(3));
}

TEST_CASE("few bytes may be changed after they were written, and buffers released or moved") {
  const auto context = main_setups().front().device.context();
  for (int k = 0; k < 200; ++k) {
    cl::Buffer<std::uint32_t> first(context);
    Words bytes = words(7);
    first.upload(bytes);
    std::fill(bytes.begin(), bytes.end(), 0);
    cl::Buffer<std::uint32_t> second = std::move(first);
    CHECK(second.download() == words(7));
    cl::Buffer<std::uint32_t>(context).upload(words(8));
  }
}
