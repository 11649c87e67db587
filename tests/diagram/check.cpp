#include "tests/diagram/check.hpp"

#include <doctest/doctest.h>

#include "tests/support/compare.hpp"
#include "tests/support/compare_geometry.hpp"

namespace powercell::test {

namespace {

void expect_none(const Differences& differences) {
  CHECK_MESSAGE(differences.empty(), summary(differences));
}

/// In float a corner within rounding of a wall or of the domain's boundary may lie on either side.
std::size_t uncertain_corners(Precision precision, const ReferenceDiagram& reference) {
  return precision == Precision::float32 ? 2 + reference.simplices.size() / 50 : 0;
}

}  // namespace

void check_diagram(const Setup& setup, const Domain& domain, const SeedArray& seeds,
                   const ReferenceDiagram& reference, Position position) {
  INFO(setup.name << ", " << seeds.size() << " seeds");
  Diagram diagram(setup.device, domain, setup.options);
  diagram.set_seeds(seeds.view());
  const Tolerances tolerances(unit_roundoff(diagram.precision()), domain.mesh(), seeds.view(), reference);

  const Measures& measures = diagram.measures();
  expect_none(compare_measures(measures, reference, seeds.view(), tolerances));
  const Adjacency& adjacency = diagram.adjacency();
  std::size_t optional = 0;
  expect_none(compare_walls(adjacency, reference, tolerances, &optional));
  if (position == Position::general && diagram.precision() == Precision::float64) CHECK(optional == 0);
  const Cells& cells = diagram.cells();
  expect_none(check_cells(cells, domain, measures, adjacency, tolerances));
  expect_none(check_joined(join(domain, cells), domain, measures, tolerances));
  if (position == Position::general)
    expect_none(compare_dual(diagram.dual(), reference, seeds.view(), domain.kind(),
                             uncertain_corners(diagram.precision(), reference)));
}

void check_everywhere(const Domain& domain, const SeedArray& seeds, Position position) {
  const ReferenceDiagram reference = brute_force(domain.mesh(), seeds.view());
  for (const Setup& setup : all_setups()) check_diagram(setup, domain, seeds, reference, position);
}

}  // namespace powercell::test
