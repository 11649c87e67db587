// Errors, lack of memory and interrupts in a group: nothing hangs, nothing is wrong, and the diagram stays
// usable.
#include <doctest/doctest.h>

#include <functional>
#include <optional>
#include <powercell/device_rates.hpp>
#include <powercell/opencl.hpp>

#include "lib/cl/context.hpp"
#include "tests/devices/support.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/opencl_shim.hpp"
#include "tests/support/same_bits.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

Options small_chunks(std::uint64_t pairs = 60) {
  Options options = main_setups().front().options;
  options.chunk_pairs = pairs;
  return options;
}

struct Walls {
  Measures measures;
  Adjacency adjacency;
};

Walls computed(Diagram& diagram, const SeedArray& seeds) {
  diagram.set_seeds(seeds.view());
  diagram.compute(true, false);
  return {diagram.measures(), diagram.adjacency()};
}

std::string differences(const Walls& a, const Walls& b) {
  return bit_differences(a.measures, b.measures) + bit_differences(a.adjacency, b.adjacency);
}

std::optional<Error> refused(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  return {};
}

}  // namespace

TEST_CASE(
    "calls fail somewhere in a group: an error or the same bits, no leak, and the diagram stays usable") {
  using shim::Entry;
  const shim::Scope scope;
  const Device group = opened_again(main_setups().front().device, 2);
  const SeededDomain c = with_seeds({{"islands", Domain::polygon(islands())}}, 400).front();
  Diagram plain(group.members().front(), c.domain.domain, small_chunks());
  const Walls expected = computed(plain, c.seeds);
  {
    Diagram first(group, c.domain.domain, small_chunks());  // compiles
    computed(first, c.seeds);
  }
  std::size_t errors = 0;
  for (const Entry entry :
       {Entry::clEnqueueNDRangeKernel, Entry::clEnqueueReadBuffer, Entry::clEnqueueWriteBuffer,
        Entry::clCreateBuffer, Entry::clEnqueueMapBuffer, Entry::clEnqueueUnmapMemObject,
        Entry::clSetKernelArg, Entry::clCreateKernel, Entry::clWaitForEvents})
    for (const cl_int code : {CL_OUT_OF_RESOURCES, CL_MEM_OBJECT_ALLOCATION_FAILURE})
      for (const std::uint64_t nth : {1, 5, 17, 40, 77}) {
        INFO(std::string(shim::name(entry)) << ", call " << nth << ", " << cl::error_name(code));
        shim::Alive before = shim::alive();
        {
          Diagram diagram(group, c.domain.domain, small_chunks());
          shim::fail(entry, nth, code);
          try {
            const Walls walls = computed(diagram, c.seeds);
            CHECK(differences(walls, expected) == "");
          } catch (const Error& error) {
            const std::string what = error.what();
            CHECK_MESSAGE(what.find(cl::error_name(code)) != std::string::npos, what);
            CHECK_MESSAGE(what.find(group.info().name) != std::string::npos, what);
            ++errors;
          }
          shim::behave();
          CHECK(differences(computed(diagram, c.seeds), expected) == "");
        }
        const shim::Alive after = shim::alive();
        before.programs = after.programs;  // each device keeps what it needed for the first time
        CHECK_MESSAGE(after == before, shim::to_string(after), "instead of ", shim::to_string(before));
      }
  CHECK(errors > 10);
}

TEST_CASE("a device with little memory takes smaller chunks, with the same bits") {
  const shim::Scope scope;
  const std::string selector = main_setups().front().device.info().selector();
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 8000, 3, random);
  const Device plenty = Device::choose(selector);
  Diagram plain(plenty, unit_box(3), small_chunks(4000));
  const Walls expected = computed(plain, seeds);
  shim::pretend(CL_DEVICE_MAX_MEM_ALLOC_SIZE,
                3 << 19);  // enough for a chunk of 1024 pairs, not for one of 4000
  const Device little = Device::choose(selector);
  shim::behave();
  for (const std::vector<Device>& members : {std::vector<Device>{little, plenty}, {plenty, little}}) {
    Diagram diagram(Device::group(members), unit_box(3), small_chunks(4000));
    for (int k = 0; k < 3; ++k) {
      const Walls walls = computed(diagram, seeds);
      CHECK(differences(walls, expected) == "");
    }
  }
}

TEST_CASE("memory for all devices runs out: the same bits or an error, and the group can be used again") {
  const shim::Scope scope;
  const Device group = opened_again(main_setups().front().device, 2);
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 6000, 3, random);
  Diagram plain(group.members().front(), unit_box(3), small_chunks(3000));
  const Walls expected = computed(plain, seeds);
  shim::reset_calls();
  {
    Diagram diagram(group, unit_box(3), small_chunks(3000));
    computed(diagram, seeds);
  }
  const std::size_t peak = shim::peak_buffer_bytes();
  std::size_t failed = 0;
  for (std::size_t percent = 95; percent > 2; percent = percent * 3 / 5) {
    CAPTURE(percent);
    Diagram diagram(group, unit_box(3), small_chunks(3000));
    shim::limit_memory(peak / 100 * percent);
    try {
      const Walls walls = computed(diagram, seeds);
      CHECK(differences(walls, expected) == "");
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::out_of_device_memory);
      ++failed;
    }
    shim::behave();
    const Walls walls = computed(diagram, seeds);
    CHECK(differences(walls, expected) == "");
  }
  CHECK(failed > 0);
}

TEST_CASE("a callback stops a group, which can be used again") {
  const Device group = opened_again(main_setups().front().device, 2);
  const SeededDomain c = with_seeds({{"torus", surface_of(torus(12, 7))}}, 300).front();
  int calls_left = -1;
  double reached = 0;
  bool ascending = true;
  Options options = small_chunks();
  options.progress = [&](double fraction) {
    ascending = ascending && fraction >= reached;
    reached = fraction;
    return calls_left != 0 && (calls_left < 0 || calls_left-- > 0);
  };
  Diagram diagram(group, c.domain.domain, options);
  const Walls expected = computed(diagram, c.seeds);
  CHECK(reached == 1);
  for (const int calls : {0, 1, 4, 9}) {
    CAPTURE(calls);
    reached = 0;
    calls_left = calls;
    const auto error = refused([&] { computed(diagram, c.seeds); });
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::interrupted);
    calls_left = -1;
    reached = 0;
    CHECK(differences(computed(diagram, c.seeds), expected) == "");
  }
  CHECK(ascending);
}

TEST_CASE("groups that cannot be are refused, and so is what one device does") {
  const Device device = opened_again(test_device(), 1);
  CHECK(device.members().size() == 1);
  CHECK(refused([] { Device::group({}); })->code() == ErrorCode::invalid_argument);
  const std::vector<Device> twice{device, device};
  CHECK(refused([&] { Device::group(twice); })->code() == ErrorCode::invalid_argument);
  const Device group = opened_again(test_device(), 2);
  const std::vector<Device> nested{device, group};
  CHECK(Device::group(nested).members().size() == 3);
  CHECK(refused([&] { DeviceDiagram(group, unit_box(2)); })->code() == ErrorCode::unsupported);
  CHECK(refused([&] { measure_device_rates(group); })->code() == ErrorCode::unsupported);
  CHECK(refused([&] { measure_device_latencies(group); })->code() == ErrorCode::unsupported);
  CHECK(refused([&] { settings_of(group); })->code() == ErrorCode::unsupported);
}

TEST_CASE("double precision needs all devices of a group to have it") {
  const shim::Scope scope;
  const Device with = Device::choose(test_device().info().selector());
  if (!with.info().fp64) return;
  shim::pretend(CL_DEVICE_DOUBLE_FP_CONFIG, 0);
  const Device without = Device::choose(test_device().info().selector());
  shim::behave();
  const std::vector<Device> members{with, without};
  const Device group = Device::group(members);
  Options options;
  options.precision = Precision::float64;
  const auto error = refused([&] { Diagram(group, unit_box(2), options); });
  REQUIRE(error);
  CHECK(error->code() == ErrorCode::no_fp64);
  CHECK(std::string(error->what()).find(without.info().selector() + " of a group") != std::string::npos);
  CHECK(Diagram(group, unit_box(2)).precision() == Precision::float32);
}
