// Rows of the benchmark: sizes, checks and failures.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "apps/bench/table.hpp"
#include "apps/bench/timing.hpp"

using namespace powercell;
using namespace powercell::app;

namespace {

BenchTask small_task(const io::LoadedDomain& domain) {
  BenchTask task{"square", &domain, [] { return Device::choose(); }, {}, 1000};
  task.limits.exactly = 2;
  task.options.precision = Precision::float32;
  task.rates = {1e10, 1e10};
  return task;
}

Measures two_halves() {
  Measures measures;
  measures.dimension = 2;
  measures.mass = {0.5, 0.5};
  measures.status = {SeedStatus::ok, SeedStatus::ok};
  measures.domain_measure = 1;
  return measures;
}

}  // namespace

TEST_CASE("numbers of seeds are of a small set") {
  CHECK(round_seeds(-1) == 1000);
  CHECK(round_seeds(0) == 1000);
  CHECK(round_seeds(1999) == 1000);
  CHECK(round_seeds(2000) == 2000);
  CHECK(round_seeds(4999) == 2000);
  CHECK(round_seeds(123456) == 100000);
  CHECK(round_seeds(9.9e6) == 5000000);
  CHECK(round_seeds(1e12) == 10000000);
}

TEST_CASE("measures that do not sum to the domain's are a fault") {
  const Measures right = two_halves();
  CHECK(fault_of(right, Precision::float64, nullptr) == "");
  Measures wrong = right;
  wrong.mass[1] += 1e-6;
  CHECK(fault_of(wrong, Precision::float64, nullptr).find("relative error 1.0e-06") != std::string::npos);
  CHECK(fault_of(wrong, Precision::float32, nullptr) == "");
  wrong.mass[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault_of(wrong, Precision::float32, nullptr) != "");
}

TEST_CASE("runs that differ in a bit are a fault") {
  const Measures right = two_halves();
  Measures other = right;
  CHECK(fault_of(other, Precision::float64, &right) == "");
  other.mass[0] = std::nextafter(other.mass[0], 1.0);
  CHECK(fault_of(other, Precision::float64, &right).find("two runs") == 0);
}

TEST_CASE("a row with a given number of seeds") {
  const io::LoadedDomain domain = io::read_domain("square");
  WorkCounts counts;
  const BenchRow row = time_row(small_task(domain), counts);
  REQUIRE(row.failure == "");
  CHECK(row.n == 1000);
  CHECK(row.precision == "float");
  CHECK(row.measures.seconds.size() == 2);
  CHECK(row.adjacency.seconds.size() == 2);
  CHECK(row.rate() == 1000 / row.measures.best());
  CHECK(row.measures.phases.total <= row.measures.best() * 1.001);
  CHECK(row.first_result > 0);
  CHECK(row.arithmetic_fraction() == doctest::Approx(row.rate() * row.work.operations() / 1e10));
  CHECK(row.bandwidth_fraction() == doctest::Approx(row.rate() * row.work.bytes(4) / 1e10));
  CHECK(counts.count({"square", 1000}) == 1);
}

TEST_CASE("a row whose runs are repeated until they settle or time is over") {
  const io::LoadedDomain domain = io::read_domain("square");
  BenchTask task = small_task(domain);
  task.limits = {0, 0.05};
  WorkCounts counts;
  const BenchRow row = time_row(task, counts);
  REQUIRE(row.failure == "");
  for (const TimedRuns* runs : {&row.measures, &row.adjacency}) {
    CHECK(runs->seconds.size() >= 3);
    TimedRuns before = *runs;
    before.seconds.pop_back();
    CHECK(enough(*runs, task.limits));
    CHECK(!enough(before, task.limits));
  }
}

TEST_CASE("a row reports its failure, and the record fails with it") {
  const io::LoadedDomain domain = io::read_domain("square");
  WorkCounts counts;
  BenchTask task = small_task(domain);
  task.open = []() -> Device { throw Error(ErrorCode::self_test_failed, "the device computes wrongly"); };
  BenchRecord record;
  record.rows.push_back(time_row(task, counts));
  CHECK(record.rows[0].failure == "the device computes wrongly");
  CHECK(record.failures() == 1);
  CHECK(record.failure().find("1 of 1 rows failed; square in float with 1,000 seeds") == 0);
  CHECK(table_line(record.rows[0]).find("FAILED: the device computes wrongly") != std::string::npos);
  CHECK(BenchRecord{}.failure() == "");
}

TEST_CASE("an interruption is not a failure of a row") {
  const io::LoadedDomain domain = io::read_domain("square");
  WorkCounts counts;
  BenchTask task = small_task(domain);
  task.options.progress = [](double) { return false; };
  CHECK_THROWS_AS(time_row(task, counts), Error);
}
