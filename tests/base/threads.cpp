#include "lib/base/threads.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

using namespace powercell;

TEST_CASE("parallel_for covers each index once, in at most one range per thread") {
  for (const int threads : {-1, 0, 1, 2, 7, 64})
    for (const std::size_t count : {0, 1, 2, 63, 64, 65, 1000}) {
      std::vector<std::atomic<int>> hits(count);
      std::atomic<int> ranges{0};
      parallel_for(threads, count, [&](std::size_t begin, std::size_t end) {
        ++ranges;
        CHECK(begin < end);
        for (std::size_t k = begin; k < end; ++k) ++hits[k];
      });
      for (const auto& h : hits) REQUIRE(h == 1);
      CHECK(ranges <= std::max(threads, 1));
    }
}

TEST_CASE("parallel_tasks runs each task once") {
  for (const int threads : {1, 3, 100}) {
    std::vector<std::atomic<int>> hits(500);
    parallel_tasks(threads, hits.size(), [&](int worker, std::size_t task) {
      CHECK(worker < threads);
      ++hits[task];
    });
    for (const auto& h : hits) REQUIRE(h == 1);
  }
}

TEST_CASE("exceptions reach the caller") {
  for (const int threads : {1, 4}) {
    const auto thrower = [](std::size_t begin, std::size_t end) {
      if (begin <= 90 && 90 < end) throw std::runtime_error("at 90");
    };
    CHECK_THROWS_WITH_AS(parallel_for(threads, 100, thrower), "at 90", std::runtime_error);
    std::atomic<int> done{0};
    CHECK_THROWS_WITH_AS(parallel_tasks(threads, 1000000,
                                        [&](int, std::size_t task) {
                                          ++done;
                                          if (task == 3) throw std::runtime_error("task 3");
                                        }),
                         "task 3", std::runtime_error);
    CHECK(done < 1000000);  // no task is begun after the exception
  }
}

TEST_CASE("thread_count") {
  CHECK(thread_count(5) == 5);
  CHECK(thread_count(0) >= 1);
  CHECK(thread_count(-3) >= 1);
}
