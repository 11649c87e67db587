#include "lib/base/radix_sort.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "tests/support/generators.hpp"

using namespace powercell;

namespace {

/// Sorts and compares with a stable sort of the standard library.
void check_sort(std::vector<KeyedIndex> records) {
  std::vector<KeyedIndex> expected = records, scratch(records.size());
  std::stable_sort(expected.begin(), expected.end(), [](auto a, auto b) { return a.key < b.key; });
  sort_by_key(records, scratch, 3);
  const auto same = [](const KeyedIndex& a, const KeyedIndex& b) {
    return a.key == b.key && a.index == b.index;
  };
  REQUIRE(std::equal(records.begin(), records.end(), expected.begin(), expected.end(), same));
}

}  // namespace

TEST_CASE("the sort is stable, for keys of all sizes") {
  test::Random random(test::test_seed());
  INFO(test::replay_hint());
  for (const std::size_t n : {0, 1, 1000, 1024, 5000, 300000})
    for (const unsigned bits : {0u, 3u, 20u, 64u}) {
      std::vector<KeyedIndex> records(n);
      for (std::size_t k = 0; k < n; ++k)
        records[k] = {bits == 0 ? 7 : random.next() >> (64 - bits), static_cast<std::uint32_t>(k)};
      check_sort(records);
    }
}

TEST_CASE("what is sorted but for one record is sorted") {
  for (const std::size_t n : {1000, 5000, 300000}) {
    std::vector<KeyedIndex> records(n);
    for (std::size_t k = 0; k < n; ++k) records[k] = {k / 2, static_cast<std::uint32_t>(k)};
    check_sort(records);
    for (const std::size_t at : {std::size_t{0}, n / 2, n - 1}) {
      std::vector<KeyedIndex> changed = records;
      changed[at].key = n - changed[at].key;
      check_sort(changed);
    }
  }
}
