#include "tests/applications/density/cases.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/polytope.hpp"

namespace powercell::test {

std::vector<DensityCase> flat_cases(std::size_t n) {
  Random shape(7), random(test_seed());
  std::vector<DensityCase> list;
  const auto add = [&](const char* name, const Domain& domain) {
    list.push_back({name, domain, seeds_for(domain, Distribution::white, WeightRange::W1, n, random)});
  };
  add("square", unit_box(2));
  add("square_with_holes", Domain::polygon(square_with_holes()));
  add("cube", unit_box(3));
  add("cube_tetrahedra", volume_of(cube_tetrahedra(2, 0.15, shape)));
  return list;
}

Diagram diagram_of(const DensityCase& one) {
  const Setup& setup = main_setups().front();
  Diagram diagram(setup.device, one.domain, setup.options);
  diagram.set_seeds(one.seeds.view());
  return diagram;
}

void check_walls_are_derivatives(const DensityCase& one, const Density& density, double density_scale) {
  Diagram diagram = diagram_of(one);
  const DensityIntegrals at = integrate(diagram, density, true);
  const std::size_t n = one.seeds.size();
  REQUIRE(at.walls.offset.size() == n + 1);
  REQUIRE(at.walls.wall.size() == at.walls.neighbor.size());
  const double h = spacing(one.domain.measure(), n, one.domain.cell_dimension());
  const double step = 1e-5 * h * h;
  const double unit = density_scale * std::pow(h, one.domain.cell_dimension() - 2);
  for (std::size_t j = 0; j < n; j += 7) {
    std::vector<double> weights = one.seeds.weights, expected(n, 0.0);
    for (std::uint64_t k = at.walls.offset[j]; k < at.walls.offset[j + 1]; ++k) {
      double length2 = 0;
      for (int c = 0; c < one.seeds.dimension; ++c) {
        const double q = one.seeds.coordinate(at.walls.neighbor[k], c) - one.seeds.coordinate(j, c);
        length2 += q * q;
      }
      expected[at.walls.neighbor[k]] = -at.walls.wall[k] / (2 * std::sqrt(length2));
      expected[j] -= expected[at.walls.neighbor[k]];
    }
    weights[j] += step;
    diagram.set_weights(weights);
    const std::vector<double> up = integrate(diagram, density, false).mass;
    weights[j] -= 2 * step;
    diagram.set_weights(weights);
    const std::vector<double> down = integrate(diagram, density, false).mass;
    for (std::size_t i = 0; i < n; ++i) {
      INFO("d mass " << i << " / d weight " << j);
      CHECK(std::abs((up[i] - down[i]) / (2 * step) - expected[i]) <=
            1e-3 * unit + 1e-3 * std::abs(expected[i]));
    }
  }
}

}  // namespace powercell::test
