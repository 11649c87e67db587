// A few thousand seeds in a box against CGAL and voro++, too many for brute force.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/diagram/check.hpp"
#include "tests/support/cgal.hpp"
#include "tests/support/compare.hpp"
#include "tests/support/voro.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("diagrams of boxes agree with CGAL and voro++") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int d : {2, 3})
    for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
      const std::size_t n = number_of_inputs(1200u, 3000u);
      const SeedArray seeds = random_seeds(Distribution::white, range, n, d, random);
      const RegularTriangulation cgal = regular_triangulation(seeds.view());
      const ReferenceDiagram reference =
          cut_by_candidates(box_mesh(d), seeds.view(), cgal.offset, cgal.neighbor, cgal.hidden);
      const RadicalCells voro = d == 3 ? radical_cells(seeds.view(), {}) : RadicalCells{};
      for (const Setup& setup : all_setups()) {
        INFO(setup.name << ", " << d << "D " << name(range));
        Diagram diagram(setup.device, unit_box(d), setup.options);
        diagram.set_seeds(seeds.view());
        const Tolerances tolerances(unit_roundoff(diagram.precision()), box_mesh(d), seeds.view(), reference);
        const Differences cells = compare_measures(diagram.measures(), reference, seeds.view(), tolerances);
        CHECK_MESSAGE(cells.empty(), summary(cells));
        std::size_t optional = 0;
        const Differences walls = compare_walls(diagram.adjacency(), reference, tolerances, &optional);
        CHECK_MESSAGE(walls.empty(), summary(walls));
        if (diagram.precision() == Precision::float32) continue;
        CHECK(optional == 0);
        for (std::size_t i = 0; i < voro.volume.size(); ++i)
          if (!(std::abs(diagram.measures().mass[i] - voro.volume[i]) <= 1e-9 / static_cast<double>(n)))
            FAIL_CHECK("seed " << i << ": " << diagram.measures().mass[i] << ", voro++ " << voro.volume[i]);
      }
    }
}
