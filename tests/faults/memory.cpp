// Too little device memory: smaller chunks with the same bits, then an error.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "tests/faults/jobs.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr std::size_t MiB = std::size_t{1} << 20;

/// Cases with enough pairs for several chunks of the smallest size.
std::vector<SeededDomain> cases() {
  return with_seeds({{"square", unit_box(2)},
                     {"cube", unit_box(3)},
                     {"torus", surface_of(torus(12, 7))},
                     {"ball", volume_of(ball_tetrahedra(0))}},
                    4000);
}

/// The results that need device memory.
struct Output {
  Adjacency adjacency;
  Measures measures;
  Cells cells;
};
Output compute(Diagram& diagram, const SeedArray& seeds) {
  diagram.set_seeds(seeds.view());
  return {diagram.adjacency(), diagram.measures(), diagram.cells()};
}
std::string differences(const Output& a, const Output& b) {
  return bit_differences(a.adjacency, b.adjacency) + bit_differences(a.measures, b.measures) +
         bit_differences(a.cells, b.cells);
}

/// The number of uploads, which grows with that of chunks. (That of launches may not: small chunks are not
/// packed.)
std::uint64_t uploads() {
  return shim::calls()[static_cast<std::size_t>(shim::Entry::clEnqueueWriteBuffer)];
}

}  // namespace

TEST_CASE("decreasing device memory: smaller chunks with the same bits, then an error, then recovery") {
  const shim::Scope scope;
  const Setup& setup = main_setups().front();
  for (const SeededDomain& c : cases()) {
    INFO(c.domain.name << ", " << setup.name);
    Output expected;
    std::uint64_t uploads_at_best = 0;
    std::size_t peak = 0;
    {
      Diagram plenty(setup.device, c.domain.domain, setup.options);
      compute(plenty, c.seeds);
      shim::reset_calls();
      expected = compute(plenty, c.seeds);
      uploads_at_best = uploads();
      peak = shim::peak_buffer_bytes();
      // The diagram now holds more than the limit; it must free that.
      shim::limit_memory(peak / 2);
      CHECK(differences(compute(plenty, c.seeds), expected) == "");
      shim::behave();
    }
    std::size_t with_less = 0, errors = 0;
    for (std::size_t limit = peak; limit > peak / 200; limit = limit * 3 / 5) {
      CAPTURE(peak);
      CAPTURE(limit);
      Diagram diagram(setup.device, c.domain.domain, setup.options);
      shim::limit_memory(limit);
      shim::reset_calls();
      try {
        const Output output = compute(diagram, c.seeds);
        CHECK(differences(output, expected) == "");
        CHECK(shim::peak_buffer_bytes() <= limit);
        if (limit < peak) CHECK(uploads() > uploads_at_best);
        with_less += limit < peak;
      } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::out_of_device_memory);
        CHECK(std::string(error.what()).find(setup.device.info().name) != std::string::npos);
        ++errors;
        shim::behave();
        CHECK(differences(compute(diagram, c.seeds), expected) == "");
      }
    }
    CHECK(with_less > 0);
    CHECK(errors > 0);
  }
}

TEST_CASE("a largest allocation far smaller than the memory: smaller chunks with the same bits") {
  const shim::Scope scope;
  for (const SeededDomain& c : cases()) {
    const Setup& setup = main_setups().front();
    INFO(c.domain.name << ", " << setup.name);
    Diagram plain(setup.device, c.domain.domain, setup.options);
    const Output expected = compute(plain, c.seeds);
    shim::reset_calls();
    compute(plain, c.seeds);
    const std::uint64_t uploads_at_best = uploads();

    // Less than all pairs need, but enough for the smallest chunk.
    const std::size_t largest = (c.domain.domain.cell_dimension() == 3 ? 4 : 1) * MiB / 2;
    shim::pretend(CL_DEVICE_MAX_MEM_ALLOC_SIZE, largest);
    const Device small = Device::choose(setup.device.info().selector());
    REQUIRE(small.info().largest_allocation == largest);
    Diagram diagram(small, c.domain.domain, setup.options);
    compute(diagram, c.seeds);
    shim::reset_calls();
    CHECK(differences(compute(diagram, c.seeds), expected) == "");
    CHECK(uploads() > uploads_at_best);
    shim::behave();
  }
}

TEST_CASE("unrestricted cells: smaller chunks with the same bits") {
  const shim::Scope scope;
  const Setup& setup = main_setups().front();
  const Domain ball = volume_of(ball_tetrahedra(2));
  Random random(test_seed());
  const SeedArray seeds = seeds_for(ball, Distribution::white, WeightRange::W1, 8000, random);
  const auto measures_within = [&](std::size_t limit) {
    Diagram diagram(setup.device, ball, setup.options);
    shim::reset_calls();
    shim::limit_memory(limit);
    diagram.set_seeds(seeds.view());
    return diagram.measures();
  };
  const Measures expected = measures_within(std::numeric_limits<std::size_t>::max());
  const std::size_t peak = shim::peak_buffer_bytes();
  CAPTURE(peak);
  CHECK(bit_differences(measures_within(peak / 6 * 5), expected) == "");
}

TEST_CASE("a chunk repeated after a failed unmap counts once") {
  const shim::Scope scope;
  Setup setup = main_setups().front();
  setup.options.chunk_pairs = 1500;
  setup.options.decisions = Decisions::fast;
  Random random(test_seed());
  const NamedDomain torus_surface{"torus", surface_of(torus(40, 20))};
  const std::vector<SeededDomain> several_chunks = {
      // Cells of many pieces, which extend over several chunks.
      {torus_surface, seeds_for(torus_surface.domain, Distribution::white, WeightRange::W0, 500, random)},
      // Rounding decides every cell.
      {{"cube", unit_box(3)}, grid(16, 3)}};
  for (const SeededDomain& c : several_chunks) {
    INFO(c.domain.name);
    const auto measured = [&] {
      Diagram diagram(setup.device, c.domain.domain, setup.options);
      diagram.set_seeds(c.seeds.view());
      Measures measures = diagram.measures();
      return std::pair(std::move(measures), diagram.timings());
    };
    measured();
    shim::reset_calls();
    const auto [expected, expected_timings] = measured();
    const std::uint64_t calls = shim::calls()[static_cast<std::size_t>(shim::Entry::clEnqueueUnmapMemObject)];
    // A GPU maps only what it has summed up.
    REQUIRE((calls > 1 || setup.device.info().type != DeviceInfo::Type::cpu));
    if (calls <= 1) continue;
    std::size_t survived = 0;
    for (std::uint64_t nth = 1; nth <= calls; ++nth) {
      CAPTURE(nth);
      shim::fail(shim::Entry::clEnqueueUnmapMemObject, nth, CL_OUT_OF_HOST_MEMORY);
      try {
        const auto [measures, timings] = measured();
        ++survived;
        CHECK(bit_differences(measures, expected) == "");
        CHECK(timings.retried == expected_timings.retried);
        CHECK(timings.on_host == expected_timings.on_host);
        CHECK(timings.uncertain == expected_timings.uncertain);
        CHECK(timings.rounds == expected_timings.rounds);
      } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::out_of_device_memory);
      }
      shim::behave();
    }
    CHECK(survived > 1);
  }
}

TEST_CASE("if the smallest chunk exceeds the largest allocation, the message names its size") {
  const shim::Scope scope;
  const Setup& setup = main_setups().front();
  shim::pretend(CL_DEVICE_MAX_MEM_ALLOC_SIZE, 64 << 10);
  const Device small = Device::choose(setup.device.info().selector());
  const SeededDomain c = cases()[1];
  Diagram diagram(small, c.domain.domain, setup.options);
  try {
    compute(diagram, c.seeds);
    FAIL("4000 seeds fit into 64 KiB");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::out_of_device_memory);
    const std::string what = error.what();
    CHECK(what.find("largest single allocation is 65536 bytes") != std::string::npos);
  }
  // Fewer seeds fit.
  SeedArray few{3,
                {c.seeds.positions.begin(), c.seeds.positions.begin() + 300},
                {c.seeds.weights.begin(), c.seeds.weights.begin() + 100}};
  diagram.set_seeds(few.view());
  CHECK(diagram.measures().relative_error() < 1e-12);
}
