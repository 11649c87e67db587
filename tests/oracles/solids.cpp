// Cells in solids against CGAL's exact Boolean operations, which share nothing with them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/diagram.hpp>
#include <powercell/shapes.hpp>

#include "lib/base/vectors.hpp"
#include "tests/support/cgal_solid.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Adds a sphere whose vertices are moved along their radii, to at least `least` of its radius: a star.
void add_star(Mesh& to, double radius, double least, bool outward, Random& random) {
  const TriangleMesh sphere = powercell::sphere(2);
  const auto first = static_cast<std::uint32_t>(to.vertex_count());
  for (std::size_t v = 0; v < sphere.vertices.size(); v += 3) {
    const double r = radius * random.uniform(least, 1);
    for (std::size_t k = 0; k < 3; ++k) to.vertices.push_back(r * sphere.vertices[v + k]);
  }
  for (std::size_t t = 0; t < sphere.triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k)
      to.elements.push_back(first + sphere.triangles[t + (outward || k == 0 ? k : 3 - k)]);
}

/// A star, with a cavity, a body in the cavity, or a torus.
Mesh random_surface(int trial, Random& random) {
  Mesh mesh;
  if (trial % 4 == 3) {
    const TriangleMesh ring = torus(6);
    mesh = {ring.vertices, ring.triangles};
    for (double& x : mesh.vertices) x += random.uniform(-0.03, 0.03);
    return mesh;
  }
  add_star(mesh, 1, 0.6, true, random);
  if (trial % 4 > 0) add_star(mesh, 0.4, 0.6, false, random);
  if (trial % 4 > 1) add_star(mesh, 0.15, 0.5, true, random);
  return mesh;
}

double area_of_cell(const JoinedCells& joined, std::size_t i) {
  using Point = Vector3<double>;
  double area = 0;
  for (std::uint64_t f = joined.face_offset[i]; f < joined.face_offset[i + 1]; ++f) {
    const std::uint64_t begin = joined.loop_offset[f];
    const auto at = [&](std::uint64_t e) {
      return &joined.vertices[3 * (joined.vertex_offset[i] + joined.loop[e])];
    };
    Point twice{};
    for (std::uint64_t e = begin + 2; e < joined.loop_offset[f + 1]; ++e)
      twice = twice + cross(difference<double>(at(e - 1), at(begin)), difference<double>(at(e), at(begin)));
    area += norm(twice) / 2;
  }
  return area;
}

const Device* double_device() {
  for (const Setup& setup : main_setups())
    if (setup.device.info().fp64) return &setup.device;
  return nullptr;
}

}  // namespace

TEST_CASE("random solids and their seeds agree with CGAL's corefinement") {
  if (!double_device()) return;
  INFO(replay_hint());
  Random random(test_seed());
  int compared = 0, cells = 0;
  const int trials = number_of_inputs(40, 100);
  for (int trial = 0; trial < trials; ++trial) {
    const Mesh mesh = random_surface(trial, random);
    const Domain domain = Domain::solid(mesh.vertices, mesh.elements);
    SeedArray seeds;
    const std::size_t n = 1 + random.index(8);
    for (std::size_t k = 0; k < n; ++k)
      seeds.push({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)},
                 trial % 3 * random.uniform(0, 0.2));
    Diagram diagram(*double_device(), domain);
    diagram.set_seeds(seeds.view());
    CAPTURE(trial);
    const std::size_t i = random.index(n);
    CAPTURE(i);
    const CutSolid cut = cut_solid(mesh, seeds.view(), i);
    if (!cut.known) continue;
    ++compared;
    cells += cut.volume > 0;
    CHECK(std::abs(diagram.measures().mass[i] - cut.volume) <= 1e-13);
    CHECK(std::abs(area_of_cell(diagram.joined(), i) - cut.area) <= 1e-11);
  }
  CHECK(compared >= trials * 95 / 100);
  CHECK(cells >= trials * 60 / 100);
}
