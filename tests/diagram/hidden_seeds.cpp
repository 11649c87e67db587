// If many seeds are hidden, those proved hidden are set aside before clipping
// (lib/neighbors/hidden_seeds.hpp), which must not change the results. The reference is cut by CGAL's
// adjacency.
#include <doctest/doctest.h>

#include "tests/support/cgal.hpp"
#include "tests/support/compare.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("hidden seeds: setting them aside does not change the diagram") {
  INFO(replay_hint());
  Random shape(7);
  const std::vector<NamedDomain> domains = {{"square", unit_box(2)},
                                            {"islands", Domain::polygon(islands())},
                                            {"torus", surface_of(torus(12, 7))},
                                            {"tetrahedra", volume_of(cube_tetrahedra(2, 0.15, shape))}};
  for (const NamedDomain& named : domains) {
    Random random(test_seed());
    SeedArray seeds =
        seeds_for(named.domain, Distribution::white, WeightRange::W2, number_of_inputs(1000u, 2500u), random);
    const RegularTriangulation dual = regular_triangulation(seeds.view());
    const ReferenceDiagram reference =
        cut_by_candidates(named.domain.mesh(), seeds.view(), dual.offset, dual.neighbor, dual.hidden);
    for (const Setup& setup : all_setups()) {
      INFO(named.name << ", " << setup.name);
      const Tolerances tolerances(unit_roundoff(setup.options.precision), named.domain.mesh(), seeds.view(),
                                  reference);
      Diagram diagram(setup.device, named.domain, setup.options);
      diagram.set_seeds(seeds.view());
      std::size_t optional = 0;
      const auto check = [&] {
        const Differences measures =
            compare_measures(diagram.measures(), reference, seeds.view(), tolerances);
        CHECK_MESSAGE(measures.empty(), summary(measures));
        const Differences walls = compare_walls(diagram.adjacency(), reference, tolerances, &optional);
        CHECK_MESSAGE(walls.empty(), summary(walls));
        CHECK(diagram.positions() == seeds.positions);
      };
      check();
      // Other weights make the seeds active again; then they are set aside again.
      diagram.set_weights(std::vector<double>(seeds.size(), 0.0));
      const Measures& equal = diagram.measures();
      CHECK(equal.relative_error() < 1e-5);
      diagram.set_weights(seeds.weights);
      check();
    }
  }
}
