// Triangulations of the torus: Euler's formula, volumes that sum to the domain, empty power spheres.
#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "tests/periodic/brute_force.hpp"
#include "tests/periodic/images_of_simplices.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The corner k of a row, as a point.
Vec corner(const Dual& dual, const PeriodicSpace& space, const SeedArray& seeds, std::size_t at) {
  const std::uint32_t i = dual.simplices[at];
  Vec x{seeds.coordinate(i, 0), seeds.coordinate(i, 1), seeds.dimension == 3 ? seeds.coordinate(i, 2) : 0};
  for (std::size_t k = 0; k < 3; ++k)
    x = x + static_cast<Real>(dual.shift[at][k]) *
                Vec{space.vector[k][0], space.vector[k][1], space.vector[k][2]};
  return x;
}

using Face = PeriodicSimplex;

void check_dual(Diagram& diagram, const PeriodicSpace& space, const SeedArray& seeds) {
  const Dual& dual = diagram.dual();
  const auto corners = static_cast<std::size_t>(space.dimension) + 1;
  REQUIRE(dual.corners == space.dimension + 1);
  REQUIRE(dual.shift.size() == dual.simplices.size());
  Real sum = 0;
  std::set<Face> facets, edges;
  for (std::size_t row = 0; row < dual.size(); ++row) {
    const Vec a = corner(dual, space, seeds, row * corners);
    CHECK(dual.shift[row * corners] == ImageShift{});
    const Vec b = corner(dual, space, seeds, row * corners + 1) - a,
              c = corner(dual, space, seeds, row * corners + 2) - a;
    const Real measure = space.dimension == 2
                             ? cross(b, c).z / 2
                             : dot(b, cross(c, corner(dual, space, seeds, row * corners + 3) - a)) / 6;
    CHECK(static_cast<double>(measure) > -1e-14);
    sum += measure;
    const auto at = [&](std::size_t k) {
      return std::pair(dual.simplices[row * corners + k], dual.shift[row * corners + k]);
    };
    for (std::size_t left_out = 0; left_out < corners; ++left_out) {
      Face facet;
      for (std::size_t k = 0; k < corners; ++k)
        if (k != left_out) facet.push_back(at(k));
      facets.insert(first_image(facet));
      for (std::size_t k = 0; k < left_out; ++k) edges.insert(first_image({at(k), at(left_out)}));
    }
  }
  CHECK(std::abs(static_cast<double>(sum / space.measure() - 1)) < 1e-12);
  CHECK(2 * facets.size() == corners * dual.size());
  CHECK(edges.size() >= diagram.adjacency().neighbor.size() / 2);  // fewer only for walls without area
  const std::size_t vertices = diagram.measures().count(SeedStatus::ok);
  if (space.dimension == 2) {
    CHECK(dual.size() == 2 * vertices);  // of a triangulation of the torus
  } else {
    CHECK(vertices + facets.size() == edges.size() + dual.size());
  }
}

}  // namespace

TEST_CASE("duals of periodic diagrams are triangulations of the torus") {
  INFO(replay_hint());
  Random random(test_seed());
  const Setup& setup = main_setups().front();
  const PeriodicSpace spaces[] = {periodic_box_space(2, {{-1, 2, 0}, {2, 4, 0}}, {true, true, false}, 3),
                                  lattice_space({{{1, 0.1, 0}, {3.3, 1.2, 0}, {}}}, 2, 8),
                                  periodic_box_space(3, {{0, 0, -1}, {1, 2, 0.5}}, {true, true, true}, 2),
                                  lattice_space({{{1, 0, 0}, {0.3, 1.1, 0}, {-0.2, 0.4, 0.9}}}, 3, 3)};
  for (const PeriodicSpace& space : spaces)
    for (const std::size_t n : {1u, 2u, 7u, 100u}) {
      INFO(space.dimension << "D, " << n);
      SeedArray seeds = periodic_seeds(space, n, random);
      const double h =
          std::pow(static_cast<double>(space.measure()) / static_cast<double>(n), 1.0 / space.dimension);
      for (double& w : seeds.weights) w = random.uniform() * h * h;
      Diagram diagram(setup.device, space.domain(), setup.options);
      diagram.set_seeds(seeds.view());
      check_dual(diagram, space, seeds);
    }
}

TEST_CASE("a tie of a periodic grid has one triangulation") {
  const Setup& setup = main_setups().front();
  const PeriodicSpace space = periodic_box_space(2, {}, {true, true, false}, 3);
  SeedArray seeds = grid(4, 2);
  Diagram diagram(setup.device, space.domain(), setup.options);
  diagram.set_seeds(seeds.view());
  check_dual(diagram, space, seeds);
}
