// Long use: many diagrams in sequence, many updates of one, many threads. These are short runs; the full ones
// (docs/reliability.md, "Load") are
//   test_load --no-skip -tc='long*'
#include <doctest/doctest.h>
#include <malloc.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <fstream>
#include <thread>

#include "tests/support/domains.hpp"
#include "tests/support/opencl_shim.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Resident memory of this process in bytes, without the memory that the allocator keeps for reuse.
std::size_t resident() {
  malloc_trim(0);
  std::size_t pages = 0, resident_pages = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident_pages;
  return resident_pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::vector<SeededDomain> cases(std::size_t n) {
  return with_seeds({{"letter U", Domain::polygon(letter_u())},
                     {"torus", surface_of(torus(12, 7))},
                     {"ball", volume_of(ball_tetrahedra(0))},
                     {"cube", unit_box(3)}},
                    n);
}

Results fresh(const Setup& setup, const SeededDomain& c) {
  Diagram diagram(setup.device, c.domain.domain, setup.options);
  diagram.set_seeds(c.seeds.view());
  return results_of(diagram);
}

constexpr std::size_t MiB = std::size_t{1} << 20;

/// Memory and objects at some time, after which they must not grow. If a cell is the first to need some
/// program, it is built, and the baseline is taken again.
class Baseline {
 public:
  void take() {
    objects_ = shim::alive();
    bytes_ = resident();
  }
  void take_if_programs_were_built() {
    if (shim::alive().programs > objects_.programs) take();
  }
  void check(const std::string& what, std::size_t allowed) const {
    const std::size_t after = resident();
    CHECK_MESSAGE(shim::alive() == objects_, shim::to_string(shim::alive()), "not ",
                  shim::to_string(objects_));
    MESSAGE(what, ": ", bytes_ / 1024, " KiB before, ", after / 1024, " KiB after");
    CHECK(after <= bytes_ + allowed);
  }

 private:
  shim::Alive objects_;
  std::size_t bytes_ = 0;
};

/// Makes and destroys `count` diagrams after `warm_up` others. Memory may grow by at most `allowed`.
void many_diagrams(std::size_t warm_up, std::size_t count, std::size_t allowed) {
  const Setup& setup = main_setups().front();
  const std::vector<SeededDomain> list = cases(100);
  std::vector<Results> expected;
  for (const SeededDomain& c : list) expected.push_back(fresh(setup, c));
  const auto make = [&](std::size_t k) {
    CHECK(bit_differences(fresh(setup, list[k % list.size()]), expected[k % list.size()]) == "");
  };
  for (std::size_t k = 0; k < warm_up; ++k) make(k);
  Baseline baseline;
  baseline.take();
  for (std::size_t k = 0; k < count; ++k) make(k);
  baseline.check(std::to_string(count) + " diagrams", allowed);
}

/// Sets `count` sets of weights in one diagram, and compares it to a new diagram at times.
void many_updates(std::size_t warm_up, std::size_t count, std::size_t every, std::size_t allowed) {
  const Setup& setup = main_setups().front();
  for (SeededDomain c : cases(60)) {
    INFO(c.domain.name);
    Random random(test_seed());
    const double h = spacing(c.domain.domain.measure(), c.seeds.size(), c.domain.domain.cell_dimension());
    Diagram diagram(setup.device, c.domain.domain, setup.options);
    diagram.set_seeds(c.seeds.view());
    std::size_t compared = 0;
    Baseline baseline;
    for (std::size_t k = 0; k < warm_up + count; ++k) {
      if (k == warm_up) {
        results_of(diagram);
        baseline.take();
      }
      set_weights(c.seeds, WeightRange::W2, h, random);
      diagram.set_weights(c.seeds.weights);
      diagram.measures();
      if (k % 3 == 0) diagram.adjacency();
      if (k > warm_up) baseline.take_if_programs_were_built();
      if (k % every != 0) continue;
      CHECK(bit_differences(results_of(diagram), fresh(setup, c)) == "");
      ++compared;
    }
    CHECK(compared >= 2);
    results_of(diagram);
    baseline.check(c.domain.name + ", " + std::to_string(count) + " updates", allowed);
  }
}

/// Runs threads that make and destroy diagrams of their own on one device.
void many_threads(std::size_t threads, std::size_t rounds) {
  for (const Setup& setup : main_setups()) {
    INFO(setup.name);
    const std::vector<SeededDomain> list = cases(80);
    std::vector<Results> expected;
    for (const SeededDomain& c : list) expected.push_back(fresh(setup, c));
    const shim::Alive objects = shim::alive();
    // A new device without programs: the first thread to need one builds and tests it.
    const Device device = Device::choose(setup.device.info().selector());
    std::atomic<std::size_t> wrong{0}, errors{0}, done{0};
    std::vector<std::thread> all;
    for (std::size_t t = 0; t < threads; ++t)
      all.emplace_back([&, t] {
        for (std::size_t round = 0; round < rounds; ++round) {
          const std::size_t k = (t + round) % list.size();
          try {
            const Setup own{setup.name, device, setup.options};
            wrong += !bit_differences(fresh(own, list[k]), expected[k]).empty();
            ++done;
          } catch (const std::exception& error) {
            ++errors;
            MESSAGE(error.what());
          }
        }
      });
    for (std::thread& thread : all) thread.join();
    CHECK(wrong == 0);
    CHECK(errors == 0);
    CHECK(done == threads * rounds);
    shim::Alive now = shim::alive();
    CHECK(now.buffers == objects.buffers);
    CHECK(now.kernels == objects.kernels);
    CHECK(now.events == objects.events);
  }
}

}  // namespace

TEST_CASE("diagrams made and destroyed leak no memory") {
  many_diagrams(40, 80, 2 * MiB);
}

TEST_CASE("updates of the weights leak no memory and give the bits of new diagrams") {
  many_updates(60, 120, 45, 2 * MiB);
}

TEST_CASE("threads with their own diagrams on one device do not disturb each other") {
  many_threads(6, 2);
}

TEST_CASE("long: a thousand diagrams made and destroyed" * doctest::skip()) {
  many_diagrams(200, 1000, 2 * MiB);
}

TEST_CASE("long: 10000 updates of the weights" * doctest::skip()) {
  many_updates(500, 10000, 1000, 2 * MiB);
}

TEST_CASE("long: 32 threads" * doctest::skip()) {
  many_threads(32, 40);
}
