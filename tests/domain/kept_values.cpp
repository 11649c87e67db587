// Values that are kept with a domain.
#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "lib/domain/region_mesh.hpp"

using powercell::KeptValues;

TEST_CASE("kept values are made once, by type, and go with their owner") {
  std::weak_ptr<const int> seen;
  {
    const KeptValues kept;
    int made = 0;
    const auto make = [&] { return std::make_shared<int>(++made); };
    CHECK(*kept.get<int>(make) == 1);
    CHECK(*kept.get<int>(make) == 1);
    CHECK(*kept.get<double>([] { return std::make_shared<double>(0.5); }) == 0.5);
    seen = kept.get<int>(make);
    CHECK(!seen.expired());
  }
  CHECK(seen.expired());
}

TEST_CASE("a copy starts without kept values") {
  KeptValues kept;
  kept.get<int>([] { return std::make_shared<int>(1); });
  const KeptValues copy(kept);
  CHECK(*copy.get<int>([] { return std::make_shared<int>(2); }) == 2);
  kept = copy;
  CHECK(*kept.get<int>([] { return std::make_shared<int>(3); }) == 3);
}

TEST_CASE("a value that could not be made is made again") {
  const KeptValues kept;
  const auto fail = []() -> std::shared_ptr<int> { throw std::runtime_error("no"); };
  CHECK_THROWS_AS(kept.get<int>(fail), std::runtime_error);
  CHECK(*kept.get<int>([] { return std::make_shared<int>(4); }) == 4);
}

TEST_CASE("threads that ask for a value at once get the same") {
  const KeptValues kept;
  std::atomic<int> made = 0;
  std::vector<const int*> got(8);
  std::vector<std::thread> threads;
  for (const int*& value : got)
    threads.emplace_back([&] {
      value = kept.get<int>([&] {
                    // A value may be made of another one.
                    kept.get<long>([] { return std::make_shared<long>(7); });
                    return std::make_shared<int>(++made);
                  })
                  .get();
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(made == 1);
  for (const int* value : got) CHECK(value == got[0]);
}
