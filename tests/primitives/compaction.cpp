#include <doctest/doctest.h>

#include "lib/primitives/scan.hpp"
#include "tests/primitives/support.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("the entries equal to the wanted value are listed in order") {
  Compaction compaction(test_context());
  for (const std::uint32_t count : counts)
    for (const std::uint32_t wanted : {0u, 1u, 200u}) {
      const auto values = random_values<std::uint32_t>(count, wanted);
      std::vector<std::uint32_t> expected;
      for (std::uint32_t k = 0; k < count; ++k)
        if (values[k] == wanted) expected.push_back(k);
      for (const std::size_t local : group_sizes) {
        CAPTURE(count);
        CAPTURE(wanted);
        CAPTURE(local);
        cl::Buffer<std::uint32_t> input(test_context()), indices(test_context()), found(test_context());
        input.upload(values);
        indices.resize(count);
        found.resize(1);
        compaction.enqueue(input.handle(), count, wanted, indices.handle(), count, found.handle(), local);
        REQUIRE(found.download()[0] == expected.size());
        std::vector<std::uint32_t> listed(expected.size());
        indices.download(std::span(listed));
        const bool equal = listed == expected;
        CHECK(equal);

        constexpr std::uint32_t unwritten = 0xfffffff0u;
        indices.upload(std::vector<std::uint32_t>(count, unwritten));
        const auto room = static_cast<std::uint32_t>(expected.size() / 2);
        compaction.enqueue(input.handle(), count, wanted, indices.handle(), room, found.handle(), local);
        CHECK(found.download()[0] == expected.size());
        std::vector<std::uint32_t> first = expected;
        std::fill(first.begin() + room, first.end(), unwritten);
        indices.download(std::span(listed));
        const bool only_the_first = listed == first;
        CHECK(only_the_first);
      }
    }
}
