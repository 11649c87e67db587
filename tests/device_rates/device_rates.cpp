// The measured rates of devices are plausible, and wrong results of their kernels are detected.
#include <doctest/doctest.h>

#include <powercell/device_rates.hpp>

#include "lib/cl/context.hpp"
#include "lib/device_rates/known.hpp"
#include "lib/device_rates/timed.hpp"

using namespace powercell;

TEST_CASE("the rates of every device are positive, and of the same order in a second measurement") {
  for (const DeviceInfo& info : devices()) {
    const Device device = Device::choose(info.selector());
    for (const Precision precision : {Precision::float32, Precision::float64}) {
      if (precision == Precision::float64 && !info.fp64) {
        CHECK_THROWS_AS(measure_device_rates(device, precision), Error);
        continue;
      }
      CAPTURE(info.name);
      const DeviceRates first = measure_device_rates(device, precision),
                        second = measure_device_rates(device, precision);
      // No device that runs OpenCL is slower, and no known device faster.
      CHECK(first.copied_bytes > 1e7);
      CHECK(first.copied_bytes < 1e14);
      CHECK(first.operations > 1e7);
      CHECK(first.operations < 1e16);
      CHECK(first.copied_bytes < 20 * second.copied_bytes);
      CHECK(second.copied_bytes < 20 * first.copied_bytes);
      CHECK(first.operations < 20 * second.operations);
      CHECK(second.operations < 20 * first.operations);
      CHECK(first.copied_scatter >= 0);
      CHECK(first.operations_scatter >= 0);
    }
  }
}

TEST_CASE("a launch and a transfer take a time between that of a clock cycle and that of a second") {
  for (const DeviceInfo& info : devices()) {
    CAPTURE(info.name);
    const DeviceLatencies latencies = measure_device_latencies(Device::choose(info.selector()));
    for (const double seconds : {latencies.launch, latencies.transfer}) {
      CHECK(seconds > 1e-9);
      CHECK(seconds < 1);
    }
  }
}

TEST_CASE("bytes go to every device and back at a rate above that of a serial line") {
  for (const DeviceInfo& info : devices()) {
    CAPTURE(info.name);
    const Device device = Device::choose(info.selector());
    for (const std::size_t bytes : {std::size_t{1}, std::size_t{4096}, std::size_t{1} << 20}) {
      const DeviceTransfers rates = measure_device_transfers(device, bytes);
      for (const double rate : {rates.to_device, rates.to_host}) {
        CHECK(rate > 1.0 * static_cast<double>(bytes));  // a call takes less than a second
        CHECK(rate < 1e14);
      }
      CHECK(rates.to_device_scatter >= 0);
      CHECK(rates.to_host_scatter >= 0);
    }
    CHECK_THROWS_AS(measure_device_transfers(device, 0), Error);
    CHECK_THROWS_AS(measure_device_transfers(device, info.largest_allocation + 1), Error);
  }
}

TEST_CASE("timings: the least counts, and the scatter is that of the lower quartile") {
  const std::vector<double> given{3, 0, 2, 2.5, 9};
  std::size_t calls = 0;
  const auto next = [&] { return given[calls++ % given.size()]; };
  const Timed five = timed({5, 5, 0}, next);
  CHECK(calls == 5);
  CHECK(five.least == 2);                               // a time of 0 is none
  CHECK(five.scatter == doctest::Approx(2.5 / 2 - 1));  // of 2, 2.5, 3, 9
  calls = 0;
  CHECK(timed({2, 100, 7.6}, next).least == 2);
  CHECK(calls == 5);  // after four calls 7.5 s are over
  calls = 0;
  timed({2, 3, 100}, next);
  CHECK(calls == 3);
  CHECK(timed({4, 4, 1}, [] { return 0.0; }).least == 0);
}

TEST_CASE_TEMPLATE("wrong sums of the chains are detected", T, float, double) {
  const std::vector<T> start = chain_starts<T>(3000);
  for (const std::uint32_t rounds : {1u, 256u, most_chain_rounds}) {
    std::vector<T> sums;
    for (const T s : start) {
      T sum = 0;
      for (int k = 0; k < 8; ++k) sum += s + static_cast<T>(k) + static_cast<T>(rounds);
      sums.push_back(sum);
    }
    CHECK(chain_fault(start, sums, rounds) == "");
    CHECK(chain_fault(start, sums, rounds + 1) != "");  // a launch that stopped a round early
    sums[2999] = 0;                                     // a work-item that did not run
    CHECK(chain_fault(start, sums, rounds).find("sum 2999") == 0);
  }
}

TEST_CASE_TEMPLATE("wrong elements of a copy are detected", T, float, double) {
  std::vector<T> part;
  for (std::size_t i = 8000; i < 9000; ++i) part.push_back(static_cast<T>(i % 8191));
  CHECK(copy_fault(part, 8000) == "");
  CHECK(copy_fault(part, 8001) != "");
  part[700] = 0;
  CHECK(copy_fault(part, 8000).find("element 8700") == 0);
}
