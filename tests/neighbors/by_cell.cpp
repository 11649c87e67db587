#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "lib/clip/clipper.hpp"
#include "lib/clip/unrestricted_cells.hpp"
#include "lib/domain/outline.hpp"
#include "lib/neighbors/tree_candidates.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct Pieces {
  std::vector<std::uint32_t> status;
  std::vector<double> measure;
};

Pieces clip_all(const Scene& scene, Candidates& candidates, const std::vector<std::uint32_t>& pair_seed,
                const std::vector<std::uint32_t>& pair_region) {
  Clipper clipper(scene, candidates, OUTPUT_MOMENTS);
  Pieces pieces;
  pieces.status = clipper.clip(pair_seed, pair_region).status;
  const std::size_t columns = 2 + static_cast<std::size_t>(scene.mesh().dimension);
  std::vector<double> wide(pair_seed.size() * columns);
  if (scene.float32()) {
    std::vector<float> narrow(wide.size());
    clipper.moments().read(narrow.data(), narrow.size() * sizeof(float));
    std::copy(narrow.begin(), narrow.end(), wide.begin());
  } else {
    clipper.moments().read(wide.data(), wide.size() * sizeof(double));
  }
  for (std::size_t k = 0; k < wide.size(); k += columns)
    pieces.measure.push_back(wide[k] * scene.frame().unit(scene.mesh().cell_dimension));
  return pieces;
}

/// Clips all pairs of seeds and regions both ways and compares the pieces, many of which are empty.
void check_same_pieces(const Domain& domain, const SeedArray& input, bool float32) {
  const Device& device = main_setups().front().device;
  const SeedSet seeds = make_seed_set(input.view(), domain.dimension(), 1);
  const PackedTree tree = build_packed_tree(seeds, 1);
  const RegionMesh mesh = with_container(domain.mesh());
  const OwnScene own(device.context(), mesh, float32, seeds, tree);
  const Scene& scene = own.scene;
  std::vector<std::uint32_t> ranks(seeds.size()), pair_seed, pair_region;
  std::iota(ranks.begin(), ranks.end(), 0U);
  for (const std::uint32_t rank : ranks)
    for (std::uint32_t region = 0; region < domain.region_count(); ++region) {
      pair_seed.push_back(rank);
      pair_region.push_back(region);
    }
  TreeCandidates by_tree(scene);
  TreeCandidates searched(scene);
  const CellWalls walls = clip_unrestricted_cells(scene, searched, ranks);
  CellCandidates by_cell(std::move(searched), walls.offset, walls.neighbor);
  const Pieces a = clip_all(scene, by_tree, pair_seed, pair_region);
  const Pieces b = clip_all(scene, by_cell, pair_seed, pair_region);
  const double tolerance = (float32 ? 1e-5 : 1e-13) * domain.measure();
  double sum = 0;
  for (std::size_t k = 0; k < a.measure.size(); ++k) {
    CAPTURE(pair_seed[k]);
    CAPTURE(pair_region[k]);
    REQUIRE(std::abs(a.measure[k] - b.measure[k]) <= tolerance);
    if (a.measure[k] > tolerance) REQUIRE(a.status[k] == b.status[k]);
    sum += b.measure[k];
  }
  CHECK(std::abs(sum - domain.measure()) <= 10 * tolerance);
}

}  // namespace

TEST_CASE("clip by cell: the pieces are those of the search in every region") {
  INFO(replay_hint());
  Random shape(7);
  const std::vector<NamedDomain> domains = {{"islands", Domain::polygon(islands())},
                                            {"tetrahedra", volume_of(cube_tetrahedra(2, 0.15, shape))}};
  for (const NamedDomain& named : domains)
    for (const bool float32 : {false, true}) {
      if (!float32 && !main_setups().front().device.info().fp64) continue;
      for (const WeightRange weights : {WeightRange::W0, WeightRange::W2})
        for (const std::size_t n : {1u, 2u, 9u, 300u}) {
          Random random(test_seed());
          CAPTURE(named.name);
          CAPTURE(float32);
          CAPTURE(n);
          check_same_pieces(named.domain, seeds_for(named.domain, Distribution::cluster, weights, n, random),
                            float32);
        }
    }
}

TEST_CASE("clip by cell: a cell with hundreds of walls") {
  // One heavy seed in the middle of a ring of 300, whose cell has a wall with each.
  SeedArray seeds;
  seeds.dimension = 2;
  for (int k = 0; k <= 300; ++k) {
    const double angle = k * 2 * 3.14159265358979 / 300, radius = k == 300 ? 0 : 0.4;
    seeds.positions.push_back(0.5 + radius * std::cos(angle));
    seeds.positions.push_back(0.5 + radius * std::sin(angle));
    seeds.weights.push_back(0);
  }
  std::vector<PolygonPart> strips;
  for (int k = 0; k < 20; ++k)
    strips.push_back({{{k / 20.0, 0}, {(k + 1) / 20.0, 0}, {(k + 1) / 20.0, 1}, {k / 20.0, 1}}, {}});
  const Domain domain = Domain::polygon(strips);
  REQUIRE(domain.region_count() >= 20);
  if (main_setups().front().device.info().fp64) check_same_pieces(domain, seeds, false);
}
