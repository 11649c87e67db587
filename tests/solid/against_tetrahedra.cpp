// Volumes by their boundary and by their tetrahedra.
#include <doctest/doctest.h>

#include "tests/solid/both_ways.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("solid: equal to the tetrahedra") {
  if (!has_double()) return;
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedMesh& named : solid_meshes(random)) {
    const Domain domain = volume_of(named.mesh);
    const Mesh surface = boundary_mesh(domain);
    const Domain solid = Domain::solid(surface.vertices, surface.elements);
    CHECK(solid.measure() == doctest::Approx(domain.measure()).epsilon(1e-14));
    for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
      for (const std::size_t n : {1, 2, 3, 8, 60, 1000}) {
        if (n == 1000 && range != WeightRange::W1 && !all_inputs()) continue;
        const SeedArray seeds = seeds_for(domain, Distribution::white, range, n, random);
        const BothWays both = compute_both_ways(domain, seeds);
        CAPTURE(named.name);
        CAPTURE(n);
        CAPTURE(name(range));
        CHECK(differences(both, seeds) == "");
        CHECK(both.unclear <= n / 100);
        CHECK(differences(compute_without_tetrahedra(solid, domain, seeds), seeds) == "");
      }
  }
}

TEST_CASE("solid: seeds that tie with the boundary") {
  if (!has_double()) return;
  Random random(1);
  for (const NamedMesh& named : solid_meshes(random)) {
    const Domain domain = volume_of(named.mesh);
    const Mesh surface = boundary_mesh(domain);
    const Domain solid = Domain::solid(surface.vertices, surface.elements);
    // Walls of the second lie in faces of the cubes, seeds of the third in vertices.
    for (const double shift : {0.0, 0.125, 0.25}) {
      const SeedArray seeds = quarters(shift);
      CAPTURE(named.name);
      CAPTURE(shift);
      CHECK(differences(compute_both_ways(domain, seeds), seeds) == "");
      CHECK(differences(compute_without_tetrahedra(solid, domain, seeds), seeds) == "");
    }
  }
}

TEST_CASE("solid: seeds on the surface, far away, and all on one side") {
  if (!has_double()) return;
  Random random(test_seed());
  for (const NamedMesh& named : solid_meshes(random)) {
    CAPTURE(named.name);
    const Domain domain = volume_of(named.mesh);
    SeedArray on_surface, outside, clusters;
    for (std::size_t v = 0; v < named.mesh.vertex_count(); v += 3)
      on_surface.push(
          {named.mesh.vertices[3 * v], named.mesh.vertices[3 * v + 1], named.mesh.vertices[3 * v + 2]}, 0);
    for (int k = 0; k < 50; ++k)
      outside.push({random.uniform(5, 9), random.uniform(5, 6), random.uniform(-1, 1)}, 0);
    for (int k = 0; k < 200; ++k)
      clusters.push({.3 + 1e-3 * random.normal(), .3 + 1e-3 * random.normal(), .3 + 1e-3 * random.normal()},
                    1e-6 * random.uniform());
    const Mesh surface = boundary_mesh(domain);
    const Domain solid = Domain::solid(surface.vertices, surface.elements);
    for (const SeedArray& seeds : {on_surface, outside, clusters}) {
      CHECK(differences(compute_both_ways(domain, seeds), seeds) == "");
      CHECK(differences(compute_without_tetrahedra(solid, domain, seeds), seeds) == "");
    }
  }
}

TEST_CASE("solid: random sets of tetrahedra, whose boundaries touch themselves everywhere") {
  if (!has_double()) return;
  INFO(replay_hint());
  Random random(test_seed());
  for (int trial = 0; trial < number_of_inputs(12, 40); ++trial) {
    const double share = random.uniform(0.05, 0.9);
    const int per_axis = 2 + static_cast<int>(random.index(3)), per_row = trial % 8 == 0 ? 4 : 3;
    const Mesh mesh = part_of(cube_tetrahedra(per_axis, trial % 2 ? 0.2 : 0, random),
                              [&](const std::array<double, 3>&) { return random.uniform() < share; });
    if (mesh.elements.size() < 8) continue;
    const Domain domain = volume_of(mesh);
    const Mesh surface = boundary_mesh(domain);
    const Domain solid = Domain::solid(surface.vertices, surface.elements);
    CHECK(solid.measure() == doctest::Approx(domain.measure()).epsilon(1e-13));
    SeedArray seeds = random_seeds(Distribution::white, static_cast<WeightRange>(trial % 3),
                                   1 + random.index(200), 3, random);
    const bool tied = trial % 4 == 0;
    if (tied) seeds = grid(per_row, 3);
    CAPTURE(trial);
    CHECK(differences(compute_both_ways(domain, seeds), seeds) == "");
    // Thirds are rounded, so that some cells are thinner than rounding: in a solid these count as empty.
    if (!tied || (per_row == 4 && per_axis != 3))
      CHECK(differences(compute_without_tetrahedra(solid, domain, seeds), seeds) == "");
  }
}

TEST_CASE("solid: a cell with hundreds of walls") {
  if (!has_double()) return;
  INFO(replay_hint());
  Random random(test_seed());
  const Domain domain = volume_of(solid_meshes(random)[3].mesh);
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 3000, 3, random);
  seeds.push({0.5, 0.5, 0.5}, 0.09);  // swallows those within 0.3, more than the cavity
  const BothWays both = compute_both_ways(domain, seeds);
  CHECK(both.walls_by_boundary.offset[3001] - both.walls_by_boundary.offset[3000] > 150);
  CHECK(differences(both, seeds) == "");
  const Mesh surface = boundary_mesh(domain);
  const Domain solid = Domain::solid(surface.vertices, surface.elements);
  CHECK(differences(compute_without_tetrahedra(solid, domain, seeds), seeds) == "");
}
