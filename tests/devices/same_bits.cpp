// Several devices of one kind give the bits of one of them, whoever clips what; of several kinds the same
// adjacency and statuses.
#include "tests/support/same_bits.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/devices/support.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct AllResults {
  Measures measures;
  Adjacency adjacency;
  Cells cells;  // not of solids
  BoundaryWalls boundary;

  explicit AllResults(Diagram& diagram) {
    measures = diagram.measures();
    adjacency = diagram.adjacency();
    if (!diagram.domain().is_solid()) cells = diagram.cells();
    boundary = diagram.boundary_walls();
  }
};

std::string differences(const AllResults& a, const AllResults& b) {
  std::string found = bit_differences(a.measures, b.measures) + bit_differences(a.adjacency, b.adjacency) +
                      bit_differences(a.cells, b.cells);
  if (a.boundary.facet != b.boundary.facet || a.boundary.measure != b.boundary.measure)
    found += "boundary walls";
  return found;
}

std::vector<SeededDomain> every_kind() {
  const Mesh mesh = icosphere(2);
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  return with_seeds({{"islands", Domain::polygon(islands())},
                     {"torus", surface_of(torus(12, 7))},
                     {"ball", volume_of(ball_tetrahedra(0))},
                     {"solid", Domain::solid(mesh.vertices, mesh.elements)},
                     {"cube", unit_box(3)},
                     {"periodic", Domain::periodic_box(low, high)}},
                    500);
}

/// Computes with small chunks until each member has had some, and compares every time.
void check_group(const Device& group, const SeededDomain& c, Options options, const AllResults& expected) {
  options.chunk_pairs = 40;
  options.threads = 3;
  Diagram diagram(group, c.domain.domain, options);
  std::vector<std::uint64_t> clipped(group.members().size());
  for (int k = 0; k < 40 && std::count(clipped.begin(), clipped.end(), 0U) > 0; ++k) {
    diagram.set_seeds(c.seeds.view());
    CHECK(differences(AllResults(diagram), expected) == "");
    const std::vector<std::uint64_t> part = shares(diagram);
    for (std::size_t m = 0; m < part.size(); ++m) clipped[m] += part[m];
  }
  CHECK(std::count(clipped.begin(), clipped.end(), 0U) == 0);
}

/// The best precision and the tree on all domains, other ways to compute on one: each compiles kernels of its
/// own.
bool is_checked(const test::Setup& setup, const NamedDomain& domain) {
  const test::Setup& first = main_setups().front();
  const bool is_first = setup.options.precision == first.options.precision &&
                        setup.options.neighbors == first.options.neighbors;
  return is_first || domain.name == "cube";
}

}  // namespace

TEST_CASE("a group of one kind gives the bits of one device on every kind of domain") {
  for (const test::Setup& setup : all_setups()) {
    if (setup.device.info().selector() != test_device().info().selector()) continue;
    const Device group = opened_again(setup.device, 3);
    for (const SeededDomain& c : every_kind()) {
      if (!is_checked(setup, c.domain)) continue;
      INFO(c.domain.name << ", " << setup.name);
      Options options = setup.options;
      Diagram one(setup.device, c.domain.domain, options);
      one.set_seeds(c.seeds.view());
      check_group(group, c, options, AllResults(one));
    }
  }
}

TEST_CASE("ties, new weights, new seeds and a selection in a group") {
  const test::Setup& setup = main_setups().front();
  const Device group = opened_again(setup.device, 2);
  Options options = setup.options;
  options.chunk_pairs = 90;
  Random random(test_seed());
  SeedArray seeds = grid(10, 3);  // the host decides every cell
  Diagram one(setup.device, unit_box(3), options), several(group, unit_box(3), options);
  const auto check = [&] {
    CHECK(bit_differences(several.measures(), one.measures()) == "");
    CHECK(bit_differences(several.adjacency(), one.adjacency()) == "");
  };
  const auto set = [&] {
    one.set_seeds(seeds.view());
    several.set_seeds(seeds.view());
  };
  set();
  check();
  for (int k = 0; k < 4; ++k) {
    set_weights(seeds, WeightRange::W2, 0.1, random);  // many seeds are hidden
    one.set_weights(seeds.weights);
    several.set_weights(seeds.weights);
    check();
  }
  std::vector<std::uint32_t> some;
  for (std::uint32_t i = 0; i < seeds.size(); i += 3) some.push_back(i);
  one.select(some);
  several.select(some);
  check();
  one.select_all();
  several.select_all();
  check();
  seeds = random_seeds(Distribution::cluster, WeightRange::W1, 1000, 3, random);
  set();
  check();
  seeds = random_seeds(Distribution::white, WeightRange::W0, 1, 3, random);
  set();
  check();
}

TEST_CASE("a loop that keeps its mesh gives the bits of one device") {
  const test::Setup& setup = main_setups().front();
  if (setup.options.precision == Precision::float32) return;
  Options options = setup.options;
  options.chunk_pairs = 100;
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 800, 2, random);
  Diagram one(setup.device, unit_box(2), options),
      several(opened_again(setup.device, 2), unit_box(2), options);
  one.set_seeds(seeds.view());
  several.set_seeds(seeds.view());
  for (int k = 0; k < 5; ++k) {
    CHECK(bit_differences(several.adjacency(), one.adjacency()) == "");
    for (double& w : seeds.weights) w += 1e-5 * random.uniform();
    one.set_weights(seeds.weights);
    several.set_weights(seeds.weights);
  }
}

TEST_CASE("devices of several kinds agree on adjacency and statuses, and each has a part") {
  const std::vector<DeviceInfo> all = devices();
  if (all.size() < 2) {
    MESSAGE("this machine has one device");
    return;
  }
  const Device group = Device::choose("all");
  CHECK(group.members().size() == all.size());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W2, 20000, 3, random);
  Options options;
  options.chunk_pairs = 1500;
  Diagram one(Device::choose(group.info().selector()), unit_box(3), options),
      several(group, unit_box(3), options);
  one.set_seeds(seeds.view());
  std::vector<std::uint64_t> clipped(all.size());
  for (int k = 0; k < 5; ++k) {
    several.set_seeds(seeds.view());
    CHECK(several.measures().status == one.measures().status);
    CHECK(several.adjacency().offset == one.adjacency().offset);
    CHECK(several.adjacency().neighbor == one.adjacency().neighbor);
    for (std::size_t m = 0; m < all.size(); ++m) clipped[m] += shares(several)[m];
  }
  for (std::size_t m = 0; m < all.size(); ++m) {
    INFO(all[m].selector() << " " << all[m].name);
    CHECK(clipped[m] > 0);
  }
}

TEST_CASE("few pairs are clipped by the first device alone") {
  Diagram diagram(opened_again(test_device(), 2), unit_box(2));
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 1000, 2, random);
  diagram.set_seeds(seeds.view());
  diagram.measures();
  CHECK(diagram.state().workspace.devices[1].scene == nullptr);
}
