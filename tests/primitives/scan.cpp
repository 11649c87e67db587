#include "lib/primitives/scan.hpp"

#include <doctest/doctest.h>

#include <numeric>

#include "tests/primitives/support.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

template <class T>
std::vector<T> scanned(ExclusiveScan& scan, const std::vector<T>& values, std::size_t local) {
  cl::Buffer<T> buffer(test_context());
  buffer.upload(values);
  scan.enqueue(buffer.handle(), static_cast<std::uint32_t>(values.size()), local);
  return buffer.download();
}

template <class T>
void check_all_counts(ExclusiveScan::Type type, T most) {
  ExclusiveScan scan(test_context(), type);
  for (const std::uint32_t count : counts) {
    const auto values = random_values<T>(count, most);
    std::vector<T> expected(count);
    std::exclusive_scan(values.begin(), values.end(), expected.begin(), T{0});
    for (const std::size_t local : group_sizes) {
      CAPTURE(count);
      CAPTURE(local);
      CHECK(scanned(scan, values, local) == expected);
    }
  }
}

}  // namespace

TEST_CASE("prefix sums equal those of the standard library") {
  check_all_counts<std::uint32_t>(ExclusiveScan::Type::uint32, 4000);
  // Sums need more than 32 bits.
  check_all_counts<std::uint64_t>(ExclusiveScan::Type::uint64, std::uint64_t{1} << 40);
}

TEST_CASE("32-bit prefix sums wrap around") {
  ExclusiveScan scan(test_context(), ExclusiveScan::Type::uint32);
  const auto values = random_values<std::uint32_t>(10000, 0xffffffffu);
  std::vector<std::uint32_t> expected(values.size());
  std::exclusive_scan(values.begin(), values.end(), expected.begin(), 0u);
  CHECK(scanned(scan, values, 0) == expected);
}
