#include <doctest/doctest.h>

#include <powercell/results.hpp>

using namespace powercell;

TEST_CASE("the total is summed with compensation") {
  Measures measures;
  measures.mass.assign(10, 1e-17);
  measures.mass.push_back(1);
  measures.mass.insert(measures.mass.end(), 10, 1e-17);
  measures.domain_measure = 1;
  CHECK(measures.total() == 1 + 2.220446049250313e-16);  // 1 + 2e-16, rounded once
  CHECK(measures.relative_error() == 2.220446049250313e-16);
}

TEST_CASE("statuses are counted") {
  Measures measures;
  measures.status = {SeedStatus::ok, SeedStatus::hidden, SeedStatus::ok, SeedStatus::duplicate};
  CHECK(measures.count(SeedStatus::ok) == 2);
  CHECK(measures.count(SeedStatus::hidden) == 1);
  CHECK(measures.count(SeedStatus::duplicate) == 1);
  CHECK(Measures{}.total() == 0);
}
