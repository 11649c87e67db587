#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "lib/pairs/pair_finder.hpp"
#include "tests/pairs/region_meshes.hpp"
#include "tests/pairs/true_pairs.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct Enumerated {
  SeedSet seeds;
  Pairs pairs;
};

Enumerated enumerate(const RegionMesh& mesh, const SeedArray& seeds) {
  Enumerated all{make_seed_set(seeds.view(), mesh.dimension, 2), {}};
  all.pairs = PairFinder(mesh, 2).by_regions(all.seeds, build_packed_tree(all.seeds, 2));
  return all;
}

Enumerated enumerate(const RegionMesh& mesh, std::size_t n, WeightRange range) {
  Random random(test_seed());
  return enumerate(mesh, random_seeds(Distribution::white, range, n, mesh.dimension, random));
}

/// Checks that the owners of random points of random regions are candidates of these regions.
void check_owners(const RegionMesh& mesh, const Enumerated& all, int samples) {
  Random random(test_seed() + 1);
  const SeedsView view{all.seeds.dimension, all.seeds.positions, all.seeds.weights};
  const std::size_t d = static_cast<std::size_t>(mesh.dimension);
  for (int s = 0; s < samples; ++s) {
    const auto r = static_cast<std::uint32_t>(random.index(mesh.region_count()));
    std::vector<double> x(d, 0.0), share;
    for (std::uint32_t slot = mesh.region_offset[r]; slot < mesh.region_offset[r + 1]; ++slot)
      share.push_back(random.uniform());
    const double sum = std::accumulate(share.begin(), share.end(), 0.0);
    for (std::size_t c = 0; c < share.size(); ++c)
      for (std::size_t k = 0; k < d; ++k)
        x[k] += share[c] / sum * mesh.vertices[mesh.region_vertex[mesh.region_offset[r] + c] * d + k];
    const auto [rank, gap] = owner(view, x);
    if (gap < 1e-12L) continue;  // x may lie outside the region by rounding
    const auto first = all.pairs.region.begin();
    CHECK(std::binary_search(first + static_cast<std::ptrdiff_t>(all.pairs.offset[rank]),
                             first + static_cast<std::ptrdiff_t>(all.pairs.offset[rank + 1]), r));
  }
}

}  // namespace

TEST_CASE("many seeds in two triangles: about one pair a seed") {
  INFO(replay_hint());
  const RegionMesh mesh = square_of_triangles(1);
  for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
    const Enumerated all = enumerate(mesh, 200000, range);
    // About 1.3 sqrt(2) sqrt(n) cells along the diagonal have two pairs; allow twice as many.
    CHECK(all.pairs.region.size() < 200000 + 4 * 448);
    check_owners(mesh, all, 200);
  }
}

TEST_CASE("ten seeds on many triangles: about one pair a triangle") {
  INFO(replay_hint());
  const RegionMesh mesh = square_of_triangles(300);
  for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
    const Enumerated all = enumerate(mesh, 10, range);
    CHECK(all.pairs.region.size() >= mesh.region_count());
    CHECK(all.pairs.region.size() < mesh.region_count() * 1.03);
    check_owners(mesh, all, 1000);
  }
}

TEST_CASE("many seeds in space and a surface of twelve triangles: only cells at the surface have pairs") {
  INFO(replay_hint());
  const RegionMesh mesh = cube_surface(1);
  for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
    const Enumerated all = enumerate(mesh, 50000, range);
    // Six faces of 0.36, each met by about 1.46 n^(2/3) cells per unit area: 4280.
    CHECK(all.pairs.region.size() > 2000);
    CHECK(all.pairs.region.size() < 8600);
    check_owners(mesh, all, 300);
  }
}

TEST_CASE("as many seeds as tetrahedra") {
  INFO(replay_hint());
  Random random(test_seed());
  const RegionMesh mesh = volume_regions(cube_tetrahedra(12, 0.2, random));
  for (const WeightRange range : {WeightRange::W0, WeightRange::W2})
    check_owners(mesh, enumerate(mesh, 10000, range), 500);
}

TEST_CASE("clusters much smaller than the regions that they straddle make few pairs") {
  INFO(replay_hint());
  Random random(test_seed());
  // Half of the seeds within 1e-7 of the diagonal of the square, where its two triangles meet.
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 20000, 2, random);
  for (std::size_t i = 0; i < 10000; ++i)
    for (int k = 0; k < 2; ++k) seeds.coordinate(i, k) = 0.5 + 1e-7 * random.uniform(-1, 1);
  const RegionMesh mesh = square_of_triangles(1);
  const Enumerated all = enumerate(mesh, seeds);
  CHECK(all.pairs.region.size() < 20000 + 7 * 142);
  check_owners(mesh, all, 300);
}

TEST_CASE("seeds far outside whose weights bring their cells into the domain") {
  INFO(replay_hint());
  Random random(test_seed());
  // These are the Voronoi cells of y: |x-y-t|^2 - 2 t.y is |x-y|^2 plus a term common to all seeds.
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 16000, 2, random);
  for (std::size_t i = 0; i < 16000; ++i) {
    seeds.weights[i] = 2 * 2 * seeds.coordinate(i, 0);
    seeds.coordinate(i, 0) += 2;
  }
  const RegionMesh mesh = square_of_triangles(1);
  const auto start = std::chrono::steady_clock::now();
  const Enumerated all = enumerate(mesh, seeds);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  CHECK(seconds.count() < 30);  // a test of each pair takes minutes
  CHECK(all.pairs.region.size() < 16000 + 4 * 127);
  check_owners(mesh, all, 300);
}

TEST_CASE("weights over six decades: nodes of mixed weights are refined") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 50000, 3, random);
  const double h = spacing(1, seeds.size(), 3);
  for (double& w : seeds.weights) w = h * h * std::pow(10.0, random.uniform(-3, 3));
  const RegionMesh mesh = cube_surface(10);
  const Enumerated all = enumerate(mesh, seeds);
  // A few hundred heavy seeds share the 1200 triangles.
  CHECK(all.pairs.region.size() < 3 * mesh.region_count());
  check_owners(mesh, all, 300);
}

TEST_CASE("one region, no seeds, no regions") {
  RegionMesh one = square_of_triangles(1);
  one.source.resize(1);
  one.region_offset.resize(2);
  one.region_vertex.resize(3);
  const Enumerated all = enumerate(one, 100, WeightRange::W2);
  CHECK(all.pairs.region == std::vector<std::uint32_t>(all.seeds.size(), 0));
  CHECK(all.pairs.offset.back() == all.seeds.size());

  const SeedSet none = make_seed_set(SeedsView{2, {}, {}}, 2, 1);
  const Pairs without_seeds =
      PairFinder(square_of_triangles(2), 1).by_regions(none, build_packed_tree(none, 1));
  CHECK(without_seeds.offset == std::vector<std::uint64_t>{0});
  CHECK(without_seeds.region.empty());

  RegionMesh empty;
  empty.dimension = 2;
  CHECK(enumerate(empty, 5, WeightRange::W0).pairs.offset == std::vector<std::uint64_t>(6, 0));
}

TEST_CASE("the progress callback is called, and can stop the search") {
  const RegionMesh mesh = square_of_triangles(40);
  Random random(1);
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 1000, 2, random);
  const SeedSet set = make_seed_set(seeds.view(), 2, 1);
  const PackedTree tree = build_packed_tree(set, 1);
  double last = 0;
  PairFinder(mesh, 1).by_regions(set, tree, [&](double fraction) {
    CHECK(fraction > last);
    last = fraction;
    return true;
  });
  CHECK(last == 1);
  for (const int threads : {1, 3}) {
    int calls = 0;
    try {
      PairFinder(mesh, threads).by_regions(set, tree, [&](double) { return ++calls < 2; });
      // With more threads the calling thread may run fewer than two tasks.
      CHECK(threads > 1);
      CHECK(calls < 2);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::interrupted);
      CHECK(calls == 2);
    }
  }
}

TEST_CASE("the search at the boundary calls the progress callback with 0") {
  const RegionMesh mesh = Domain::polygon(square_with_holes()).mesh();
  Random random(1);
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 1000, 2, random);
  const SeedSet set = make_seed_set(seeds.view(), 2, 1);
  const PackedTree tree = build_packed_tree(set, 1);
  PairFinder finder(mesh, 1);
  int calls = 0;
  finder.at_boundary(set, tree, {}, [&](double fraction) {
    CHECK(fraction == 0);
    return ++calls > 0;
  });
  CHECK(calls > 0);
  CHECK_THROWS_AS(finder.at_boundary(set, tree, {}, [](double) { return false; }), Error);
}
