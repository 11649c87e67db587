// The repaired dual mesh is the one that is made anew.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lib/update/repair.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

template <int D>
std::vector<Site> random_sites(std::size_t count, double weights, Random& random) {
  std::vector<Site> sites(count);
  for (Site& site : sites)
    site = {random.uniform(), random.uniform(), D == 3 ? random.uniform() : 0, weights * random.uniform()};
  return sites;
}

template <int D>
std::set<typename DualMesh<D>::Corners> simplices(const DualMesh<D>& mesh) {
  std::set<typename DualMesh<D>::Corners> all;
  for (std::uint32_t s = 0; s < mesh.simplex_count(); ++s) {
    if (mesh.is_removed(s)) continue;
    auto corner = mesh.simplex(s).corner;
    std::sort(corner.begin(), corner.end());
    all.insert(corner);
  }
  return all;
}

/// Every facet has two sides that know of each other, every simplex is positive, no facet is broken.
template <int D>
bool is_right(const DualMesh<D>& mesh) {
  for (std::uint32_t s = 0; s < mesh.simplex_count(); ++s) {
    if (mesh.is_removed(s)) continue;
    if (orientation(mesh.places(s)) <= 0) return false;
    for (std::size_t k = 0; k <= D; ++k) {
      const std::uint32_t beyond = mesh.simplex(s).across[k];
      if (beyond == mesh.outside) continue;
      if (mesh.across(beyond) != mesh.facet(s, k) || mesh.conflict(s, mesh.opposite(beyond)) >= 0)
        return false;
    }
  }
  return true;
}

/// Moves sites and changes weights; sums what the repairs did.
template <int D>
void check_repairs(std::size_t count, double move, double change, Random& random, RepairCounts& sum) {
  const double h = std::pow(static_cast<double>(count), -1.0 / D);
  std::vector<Site> sites = random_sites<D>(count, h * h, random);
  const auto frame = FarFrame<D>::around(sites, {0, 0, 0}, {1, 1, 1});
  DualMesh<D> mesh;
  mesh.build(sites, frame.points);
  mesh.sort_simplices();
  REQUIRE(is_right(mesh));
  std::vector<Center> centers;
  for (int round = 0; round < 4; ++round) {
    for (Site& site : sites) {
      for (std::size_t k = 0; k < D; ++k) site[k] += move * h * random.uniform(-1, 1);
      site[3] += change * h * h * random.uniform(-1, 1);
    }
    std::copy(sites.begin(), sites.end(), mesh.sites().begin());
    const RepairCounts counts = repair(mesh, find_broken(mesh, move > 0, 2, centers), move > 0, centers);
    sum.flips += counts.flips;
    sum.refilled += counts.refilled;
    sum.inserted += counts.inserted;
    CHECK(is_right(mesh));
    DualMesh<D> fresh;
    fresh.build(sites, frame.points);
    CHECK(simplices(mesh) == simplices(fresh));
    CHECK(mesh.hidden().size() == fresh.hidden().size());
  }
}

}  // namespace

TEST_CASE("a repaired mesh is the regular triangulation") {
  INFO(replay_hint());
  Random random(test_seed());
  RepairCounts plane, space;
  for (const std::size_t count : {1, 2, 3, 4, 5, 30, 1000})
    for (const double move : {0.0, 1e-3, 0.05})
      for (const double change : {0.0, 0.01, 0.5}) {
        INFO(count << " sites, moved by " << move << ", weights changed by " << change);
        check_repairs<2>(count, move, change, random, plane);
        check_repairs<3>(count, move, change, random, space);
      }
  for (const RepairCounts& counts : {plane, space}) {
    CHECK(counts.flips > 100);
    CHECK(counts.refilled > 0);
    CHECK(counts.inserted > 10);
  }
}

TEST_CASE("sites that tie have no mesh") {
  const std::vector<Site> square{{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}};
  const auto frame = FarFrame<2>::around(square, {0, 0, 0}, {1, 1, 0});
  DualMesh<2> mesh;
  CHECK_THROWS_AS(mesh.build(square, frame.points), MeshUnusable);
}

TEST_CASE("a frame holds sites near where they were, and no others") {
  Random random(test_seed());
  std::vector<Site> sites = random_sites<3>(10, 1, random);
  const auto frame = FarFrame<3>::around(sites, {0, 0, 0}, {1, 1, 1});
  CHECK(frame.holds(sites));
  sites[3][1] += 1;
  CHECK(frame.holds(sites));
  sites[3][1] += 10;
  CHECK_FALSE(frame.holds(sites));
  sites[3] = {0.5, 0.5, 0.5, -1e5};
  CHECK_FALSE(frame.holds(sites));
}
