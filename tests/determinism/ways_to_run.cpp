// A device gives the same bits for any chunks, threads, work-groups, launches and threads of the driver.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <powercell/opencl.hpp>

#include "lib/cl/buffer.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/opencl_shim.hpp"
#include "tests/support/permuted.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::vector<SeededDomain> cases(std::size_t n) {
  return with_seeds({{"islands", Domain::polygon(islands())},
                     {"torus", surface_of(torus(12, 7))},
                     {"ball", volume_of(ball_tetrahedra(0))},
                     {"cube", unit_box(3)}},
                    n);
}

Results results(const Device& device, const Domain& domain, const SeedArray& seeds, const Options& options) {
  Diagram diagram(device, domain, options);
  diagram.set_seeds(seeds.view());
  return results_of(diagram);
}

/// Measures and statuses of a DeviceDiagram, as stored in device memory.
template <class Real>
std::vector<Real> device_results(const Setup& setup, const Domain& domain, const SeedArray& seeds,
                                 std::uint64_t launch_pairs) {
  Options options = setup.options;
  options.chunk_pairs = launch_pairs;
  DeviceDiagram diagram(setup.device, domain, options);
  const auto context = setup.device.context();
  cl::Buffer<Real> positions(context), weights(context), measures(context);
  cl::Buffer<std::uint32_t> status(context);
  positions.upload(std::vector<Real>(seeds.positions.begin(), seeds.positions.end()));
  weights.upload(std::vector<Real>(seeds.weights.begin(), seeds.weights.end()));
  measures.resize(seeds.size() * (2 + static_cast<std::size_t>(seeds.dimension)));
  status.resize(seeds.size());
  diagram.enqueue(positions.handle(), weights.handle(), static_cast<std::uint32_t>(seeds.size()),
                  measures.handle(), status.handle());
  std::vector<Real> values = measures.download();
  for (const std::uint32_t s : status.download()) values.push_back(static_cast<Real>(s));
  return values;
}

template <class Real>
bool same(const std::vector<Real>& a, const std::vector<Real>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Real)) == 0;
}

/// Calls body with a float or a double, by the precision of the setup.
template <class Body>
void in_precision(const Setup& setup, const Body& body) {
  setup.options.precision == Precision::float32 ? body(float{}) : body(double{});
}

bool has_tree(const Setup& setup) {
  return setup.options.neighbors == Neighbors::tree;
}

/// Writes the results of some small diagrams, for comparison to those of a process with other settings.
void write_results(const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  const auto put = [&](const auto& values) {
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(values[0])));
  };
  for (const SeededDomain& c : cases(300))
    for (const Setup& setup : main_setups()) {
      const Results r = results(setup.device, c.domain.domain, c.seeds, setup.options);
      put(r.measures.mass), put(r.measures.centroid), put(r.measures.second_moment), put(r.measures.status);
      put(r.adjacency.offset), put(r.adjacency.neighbor), put(r.adjacency.wall);
      put(r.cells.vertices), put(r.cells.border), put(r.cells.loop), put(r.dual.simplices);
    }
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

constexpr const char* results_file = "POWERCELL_TEST_RESULTS";

}  // namespace

TEST_CASE("chunks and host threads change no bit") {
  for (const SeededDomain& c : cases(300))
    for (const Setup& setup : all_setups()) {
      INFO(c.domain.name << ", " << setup.name);
      const Results expected = results(setup.device, c.domain.domain, c.seeds, setup.options);
      for (const auto& [pairs, threads] :
           {std::pair<std::uint64_t, int>{40, 1}, {333, 2}, {1000, 5}, {0, 16}, {0, 1}}) {
        const std::string way =
            "chunks of " + std::to_string(pairs) + ", " + std::to_string(threads) + " threads";
        INFO(way);
        Options options = setup.options;
        options.chunk_pairs = pairs;
        options.threads = threads;
        CHECK(bit_differences(results(setup.device, c.domain.domain, c.seeds, options), expected) == "");
      }
    }
}

TEST_CASE("chunks of one pair change no bit") {
  const SeededDomain cube = cases(60).back();
  for (const Setup& setup : all_setups()) {
    INFO(setup.name);
    Options options = setup.options;
    options.chunk_pairs = 1;
    const Results expected = results(setup.device, cube.domain.domain, cube.seeds, setup.options);
    CHECK(bit_differences(results(setup.device, cube.domain.domain, cube.seeds, options), expected) == "");
  }
}

/// Compares runs with work-groups of these sizes, for which the driver may have to compile again.
void check_groups(const SeededDomain& c, const Setup& setup, std::initializer_list<std::size_t> sizes) {
  const shim::Scope scope;
  INFO(c.domain.name << ", " << setup.name);
  const auto run = [&] {
    Diagram diagram(setup.device, c.domain.domain, setup.options);
    diagram.set_seeds(c.seeds.view());
    diagram.cells();
    return Results{diagram.measures(), diagram.adjacency(), diagram.cells(), {}};
  };
  const Results expected = run();
  in_precision(setup, [&]<class Real>(Real) {
    const auto on_device = device_results<Real>(setup, c.domain.domain, c.seeds, 0);
    for (const std::size_t items : sizes) {
      INFO("groups of " << items);
      shim::force_group_size(items);
      CHECK(bit_differences(run(), expected) == "");
      CHECK(same(device_results<Real>(setup, c.domain.domain, c.seeds, 0), on_device));
      shim::behave();
    }
  });
}

TEST_CASE("the size of work-groups changes no bit") {
  check_groups(cases(200).back(), main_setups().front(), {1});
}

TEST_CASE("campaign: the size of work-groups changes no bit" * doctest::skip()) {
  for (const SeededDomain& c : cases(200))
    for (const Setup& setup : all_setups())
      if (has_tree(setup)) check_groups(c, setup, {1, 8, 24, 128});
}

TEST_CASE("DeviceDiagram: launches and the order of the seeds change no bit") {
  for (const SeededDomain& c : cases(300))
    for (const Setup& setup : all_setups()) {
      if (!has_tree(setup)) continue;
      INFO(c.domain.name << ", " << setup.name);
      in_precision(setup, [&]<class Real>(Real) {
        const auto expected = device_results<Real>(setup, c.domain.domain, c.seeds, 0);
        for (const std::uint64_t pairs : {77, 1000})
          CHECK(same(device_results<Real>(setup, c.domain.domain, c.seeds, pairs), expected));
        Random random(test_seed());
        const Permutation from = random_permutation(c.seeds.size(), random);
        const auto moved = device_results<Real>(setup, c.domain.domain, permuted(c.seeds, from), 0);
        const std::size_t n = c.seeds.size(), columns = expected.size() / n - 1;
        std::size_t differ = 0;
        for (std::size_t k = 0; k < n; ++k) {
          differ +=
              std::memcmp(&moved[k * columns], &expected[from[k] * columns], columns * sizeof(Real)) != 0;
          differ += moved[n * columns + k] != expected[n * columns + from[k]];
        }
        CHECK(differ == 0);
      });
    }
}

TEST_CASE("child: write results" * doctest::skip()) {
  const char* path = std::getenv(results_file);
  REQUIRE(path);
  write_results(path);
}

TEST_CASE("another process, with another number of driver threads, gives the same bits") {
  // PoCL reads the number of its threads from the environment; other drivers run the same again.
  namespace fs = std::filesystem;
  const fs::path here = fs::temp_directory_path() / ("powercell-bits-" + std::to_string(getpid()));
  write_results(here);
  const std::string expected = bytes_of(here);
  CHECK(expected.size() > 100000);
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  for (const char* threads : {"1", "3"}) {
    INFO(threads << " threads");
    const fs::path there = here.string() + "." + threads;
    const std::string command = "POCL_MAX_PTHREAD_COUNT=" + std::string(threads) + " " + results_file + "='" +
                                there.string() + "' '" + program +
                                "' --no-skip -tc='child: write results' > /dev/null";
    CHECK(std::system(command.c_str()) == 0);
    CHECK(bytes_of(there) == expected);
    fs::remove(there);
  }
  fs::remove(here);
}
