// Ranges by speed: each item once, in order, and all members end together.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "lib/diagram/chunk_pipeline.hpp"

using namespace powercell;

namespace {

struct Outcome {
  double end = 0;                     // when the last member ended
  std::vector<std::uint64_t> shares;  // items by member
};

/// Members of these true speeds take ranges, each when it is free.
Outcome simulated(std::uint64_t total, const std::vector<Sharing::Member>& members,
                  const std::vector<double>& speed) {
  Sharing sharing(total, 16, members);
  std::vector<double> free_at(speed.size(), 0);
  std::vector<bool> left(speed.size(), false);
  Outcome outcome{0, std::vector<std::uint64_t>(speed.size())};
  std::uint64_t next = 0;
  while (std::count(left.begin(), left.end(), false) > 0) {
    std::size_t m = speed.size();
    for (std::size_t k = 0; k < speed.size(); ++k)
      if (!left[k] && (m == speed.size() || free_at[k] < free_at[m])) m = k;
    const Sharing::Range range = sharing.take(m);
    if (range.empty()) {
      left[m] = true;
      continue;
    }
    CHECK(range.begin == next);
    next = range.end;
    const auto items = range.end - range.begin;
    const double seconds = static_cast<double>(items) / speed[m];
    sharing.took(m, items, seconds);
    free_at[m] += seconds;
    outcome.shares[m] += items;
    outcome.end = std::max(outcome.end, free_at[m]);
  }
  CHECK(next == total);
  return outcome;
}

double ideal(std::uint64_t total, const std::vector<double>& speed) {
  return static_cast<double>(total) / std::accumulate(speed.begin(), speed.end(), 0.0);
}

}  // namespace

TEST_CASE("members of any speeds, not known before, end nearly together") {
  for (const std::vector<double>& speed :
       {std::vector<double>{1000}, {1000, 1000}, {1000, 100}, {100, 1000}, {3000, 2000, 500, 70}}) {
    CAPTURE(speed.size());
    CAPTURE(speed.front());
    const std::uint64_t total = 1000000;
    const std::vector<Sharing::Member> members(speed.size(), {20000, 0});
    CHECK(simulated(total, members, speed).end < 1.06 * ideal(total, speed));
  }
}

TEST_CASE("speeds that are known beforehand count from the first range on") {
  const std::uint64_t total = 40000;
  const std::vector<double> speed{1000, 250};
  const Outcome outcome = simulated(total, {{20000, 1000}, {20000, 250}}, speed);
  CHECK(outcome.end < 1.1 * ideal(total, speed));
  CHECK(outcome.shares[0] > 3 * outcome.shares[1]);
}

TEST_CASE("a member that would be the last to end gets nothing") {
  const Outcome outcome = simulated(1000, {{500, 1e6}, {500, 1}}, {1e6, 1});
  CHECK(outcome.end < 1);
}

TEST_CASE("ranges of a member alone are as long as it can take, of none there is nothing") {
  Sharing alone(100, 10, {{40, 0}});
  CHECK(alone.take(0).end == 40);
  alone.limit(0, 20);
  CHECK(alone.take(0).end == 60);
  CHECK(alone.take(0).end == 80);
  CHECK(alone.take(0).end == 100);
  CHECK(alone.take(0).empty());
  CHECK(Sharing(0, 10, {{40, 0}, {40, 0}}).take(1).empty());
}
