#include "lib/primitives/radix_sort.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "tests/primitives/support.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Keys = std::vector<std::uint64_t>;

struct Sorted {
  Keys keys;
  std::vector<std::uint32_t> values;
  bool operator==(const Sorted&) const = default;
};

/// Values are the indices of the keys, so they also show whether the sort is stable.
std::vector<std::uint32_t> indices(std::size_t count) {
  std::vector<std::uint32_t> values(count);
  std::iota(values.begin(), values.end(), 0u);
  return values;
}

Sorted sorted_by_device(RadixSort& sort, const Keys& keys, unsigned bits) {
  cl::Buffer<std::uint64_t> key_buffer(test_context());
  cl::Buffer<std::uint32_t> value_buffer(test_context());
  key_buffer.upload(keys);
  value_buffer.upload(indices(keys.size()));
  sort.enqueue(key_buffer.handle(), value_buffer.handle(), static_cast<std::uint32_t>(keys.size()), bits);
  return {key_buffer.download(), value_buffer.download()};
}

Sorted sorted_by_host(const Keys& keys) {
  Sorted result{{}, indices(keys.size())};
  std::stable_sort(result.values.begin(), result.values.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  for (const std::uint32_t at : result.values) result.keys.push_back(keys[at]);
  return result;
}

void check(const char* kind, RadixSort& sort, const Keys& keys, unsigned bits) {
  CAPTURE(kind);
  CAPTURE(keys.size());
  CAPTURE(bits);
  // Compared outside of CHECK, or doctest would print a million keys.
  const bool equal = sorted_by_device(sort, keys, bits) == sorted_by_host(keys);
  CHECK(equal);
}

}  // namespace

TEST_CASE("pairs are sorted as by std::stable_sort") {
  RadixSort sort(test_context());
  for (const std::uint32_t count : counts) {
    Keys keys = random_values<std::uint64_t>(count, ~std::uint64_t{0});
    check("random", sort, keys, 64);
    std::sort(keys.begin(), keys.end());
    check("ascending", sort, keys, 64);
    std::reverse(keys.begin(), keys.end());
    check("descending", sort, keys, 64);
    check("all equal", sort, Keys(count, 0x0123456789abcdefu), 64);
    check("many equal", sort, random_values<std::uint64_t>(count, 9), 64);
  }
}

TEST_CASE("keys of few bits are sorted") {
  RadixSort sort(test_context());
  for (const unsigned bits : {1u, 3u, 8u, 9u, 17u, 31u, 32u, 63u})
    check("random", sort, random_values<std::uint64_t>(5000, (std::uint64_t{1} << bits) - 1), bits);
}

TEST_CASE("the order does not depend on the size of digits, tiles and work-groups") {
  const Keys keys = random_values<std::uint64_t>(70001, 5000);
  const Sorted expected = sorted_by_host(keys);
  for (const unsigned digit_bits : {4u, 8u})
    for (const std::uint32_t tiles : {1u, 2u, 7u, 64u, 1000u})
      for (const std::size_t local : group_sizes) {
        CAPTURE(digit_bits);
        CAPTURE(tiles);
        CAPTURE(local);
        RadixSort sort(test_context(), {digit_bits, tiles, local});
        const bool equal = sorted_by_device(sort, keys, 64) == expected;
        CHECK(equal);
      }
}
