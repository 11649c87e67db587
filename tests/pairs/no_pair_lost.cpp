#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

#include "lib/pairs/pair_finder.hpp"
#include "tests/pairs/region_meshes.hpp"
#include "tests/pairs/true_pairs.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct NamedMesh {
  std::string name;
  RegionMesh mesh;
  double most;  // candidates per true pair on random seeds: the largest measured, plus a tenth
};

std::vector<NamedMesh> meshes() {
  Random random(test_seed());
  std::vector<NamedMesh> all;
  all.push_back({"square of 2 triangles", square_of_triangles(1), 2.2});
  all.push_back({"square of 200 triangles", square_of_triangles(10), 1.4});
  all.push_back({"disc of 3 polygons", disc_of_polygons(40), 1.9});
  all.push_back({"icosphere", surface_regions(icosphere(1)), 1.6});
  all.push_back({"cube surface", cube_surface(1), 2.1});
  all.push_back({"triangle soup", triangle_soup(120, random), 1.5});
  all.push_back({"cube of 6 tetrahedra", volume_regions(cube_tetrahedra(1, 0, random)), 2.1});
  all.push_back({"cube of 162 tetrahedra", volume_regions(cube_tetrahedra(3, 0.2, random)), 1.7});
  all.push_back({"8 boxes", boxes(2), 2.1});
  return all;
}

void check_rows(const Pairs& pairs, std::size_t seeds) {
  REQUIRE(pairs.offset.size() == seeds + 1);
  REQUIRE(pairs.offset.back() == pairs.region.size());
  for (std::size_t i = 0; i < seeds; ++i)
    for (std::uint64_t k = pairs.offset[i] + 1; k < pairs.offset[i + 1]; ++k)
      REQUIRE(pairs.region[k - 1] < pairs.region[k]);
}

void check_none_lost(const PairSet& found, const PairSet& expected) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> lost;
  std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(), std::back_inserter(lost));
  CHECK_MESSAGE(lost.empty(), lost.size(), " pairs lost, the first: region ",
                lost.empty() ? 0 : lost[0].first, ", rank ", lost.empty() ? 0 : lost[0].second);
}

/// Searches by cells, with every `step`th other seed as a neighbour of each cell. No true pair may be
/// missing, whatever the neighbours are.
void check_by_cells(const RegionMesh& mesh, const SeedSet& set, const PairSet& expected, std::size_t step) {
  CellWalls walls;
  std::vector<std::uint32_t> ranks;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    ranks.push_back(i);
    walls.offset.push_back(static_cast<std::uint32_t>(walls.neighbor.size()));
    for (std::uint32_t j = i % static_cast<std::uint32_t>(step); j < set.size();
         j += static_cast<std::uint32_t>(step))
      if (j != i) walls.neighbor.push_back(j);
  }
  walls.offset.push_back(static_cast<std::uint32_t>(walls.neighbor.size()));
  const Pairs pairs = PairFinder(mesh, 1).by_cells(set, ranks, walls);
  check_rows(pairs, set.size());
  check_none_lost(as_set(pairs), expected);
  const Pairs again = PairFinder(mesh, 3).by_cells(set, ranks, walls);
  CHECK(again.offset == pairs.offset);
  CHECK(again.region == pairs.region);

  // Ranks that are not searched have one pair, with the container.
  ranks.erase(ranks.begin(), ranks.begin() + static_cast<std::ptrdiff_t>(ranks.size() / 2));
  const Pairs half = PairFinder(mesh, 1).by_cells(set, ranks, walls);
  check_rows(half, set.size());
  for (std::size_t i = 0; i < set.size() / 2; ++i) {
    REQUIRE(half.offset[i + 1] == half.offset[i] + 1);
    CHECK(half.region[half.offset[i]] == mesh.region_count());
  }
  CHECK(half.region.size() - set.size() / 2 == pairs.region.size() - pairs.offset[set.size() / 2]);
}

/// Checks that no true pair is missing, rows ascend, and the result is the same for any number of threads.
/// Returns the number of candidates per true pair.
double check(const RegionMesh& mesh, const SeedArray& seeds) {
  const SeedSet set = make_seed_set(seeds.view(), mesh.dimension, 1);
  const PackedTree tree = build_packed_tree(set, 1);
  const Pairs pairs = PairFinder(mesh, 1).by_regions(set, tree);
  check_rows(pairs, set.size());

  const PairSet expected = true_pairs(mesh, set);
  const PairSet found = as_set(pairs);
  check_none_lost(found, expected);
  REQUIRE(!expected.empty());

  for (const int threads : {2, 5}) {
    const Pairs again = PairFinder(mesh, threads).by_regions(set, tree);
    CHECK(again.offset == pairs.offset);
    CHECK(again.region == pairs.region);
  }
  for (const std::size_t step : {1, 7}) check_by_cells(mesh, set, expected, step);
  return static_cast<double>(found.size()) / static_cast<double>(expected.size());
}

SeedArray heavy(int dimension, Random& random) {
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 120, dimension, random);
  double most = 0;
  for (const double w : seeds.weights) most = std::max(most, w);
  seeds.weights[60] = 1e6 * most;
  return seeds;
}

SeedArray far_outside(int dimension, Random& random) {
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 60, dimension, random);
  const SeedArray far = random_seeds(Distribution::white, WeightRange::W1, 60, dimension, random,
                                     Box{{50, 60, 70}, {53, 63, 73}});
  seeds.positions.insert(seeds.positions.end(), far.positions.begin(), far.positions.end());
  seeds.weights.insert(seeds.weights.end(), far.weights.begin(), far.weights.end());
  return seeds;
}

SeedArray all_outside(int dimension, Random& random) {
  return random_seeds(Distribution::white, WeightRange::W1, 150, dimension, random,
                      Box{{-3, 2, 4}, {-1, 4, 7}});
}

}  // namespace

TEST_CASE("no pair is lost and few are superfluous: random seeds and weights") {
  INFO(replay_hint());
  for (const NamedMesh& m : meshes()) {
    Random random(test_seed());
    double worst = 0;
    for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
      for (const std::size_t n : {3, 20, number_of_inputs(60, 200)}) {
        INFO(m.name, " ", std::string(name(range)), " n = ", n);
        const SeedArray seeds = random_seeds(Distribution::white, range, n, m.mesh.dimension, random);
        const double ratio = check(m.mesh, seeds);
        worst = std::max(worst, ratio);
      }
    CHECK_MESSAGE(worst < m.most, m.name);
  }
}

TEST_CASE("no pair is lost: degenerate seeds") {
  INFO(replay_hint());
  using Family = std::pair<std::string, std::function<SeedArray(int, Random&)>>;
  const std::vector<Family> families = {
      {"grid of 5", [](int d, Random&) { return grid(d == 2 ? 11 : 5, d); }},
      {"grid on corners",
       [](int d, Random&) {
         return grid(d == 2 ? 11 : 5, d, {{-.1, -.1, -.1}, {1.1, 1.1, 1.1}});
       }},
      {"heavy seed", heavy},
      {"far outside", far_outside},
      {"all outside", all_outside},
      {"cluster",
       [](int d, Random& r) {
         return random_seeds(Distribution::cluster, WeightRange::W1, number_of_inputs(60u, 150u), d, r);
       }},
      {"scales", [](int d, Random& r) { return spread_over_scales(number_of_inputs(60u, 150u), d, 9, r); }},
      {"cospherical", [](int d, Random&) { return cospherical(number_of_inputs(60u, 100u), d); }},
      {"collinear", [](int d, Random&) { return collinear(60, d); }},
      {"one seed",
       [](int d, Random& r) { return random_seeds(Distribution::white, WeightRange::W0, 1, d, r); }},
  };
  for (const NamedMesh& m : meshes())
    for (const Family& family : families) {
      Random random(test_seed());
      INFO(m.name, " ", family.first);
      check(m.mesh, family.second(m.mesh.dimension, random));
    }
}

TEST_CASE(
    "no pair is lost and few are superfluous: scaled, moved, and with a constant added to the weights") {
  INFO(replay_hint());
  struct Change {
    double scale, by, weight;
  };
  for (NamedMesh& m : meshes())
    for (const Change c : {Change{1e-6, 0, 0}, Change{1e9, 0, 0}, Change{1, 1e9, 0}, Change{1, 0, 1e6},
                           Change{1e-160, 0, 0}, Change{1e160, 0, 0}}) {
      INFO(m.name, " scaled by ", c.scale, ", moved by ", c.by, ", weights plus ", c.weight);
      Random random(test_seed());
      SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, number_of_inputs(50u, 100u),
                                     m.mesh.dimension, random);
      scale(seeds, c.scale);
      if (c.scale > 1e100) seeds.weights.assign(seeds.size(), 0.0);  // they would overflow
      for (double& x : seeds.positions) x += c.by;
      for (double& w : seeds.weights) w += c.weight;
      RegionMesh mesh = m.mesh;
      transform(mesh, c.scale, c.by);
      const double ratio = check(mesh, seeds);
      // Where squares overflow or underflow, nothing is excluded.
      if (c.scale > 1e-100 && c.scale < 1e100) CHECK(ratio < m.most);
    }
}
