#include <doctest/doctest.h>

#include <algorithm>

#include "tests/collect/cells_by_definition.hpp"
#include "tests/collect/join_laws.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("diagrams of every kind of domain join, in double and in float") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const auto& list : {polygon_domains(), surface_domains(), volume_domains(), box_domains()}) {
    for (const NamedDomain& named : list) {
      INFO("domain " << named.name);
      const SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W1, 40, random);
      for (const Setup& setup : all_setups()) {
        INFO(setup.name);
        Diagram diagram(setup.device, named.domain, setup.options);
        diagram.set_seeds(seeds.view());
        const JoinedCells joined = join(named.domain, diagram.cells());
        const double tolerance = 1000 * unit_roundoff(diagram.precision()) * named.domain.measure();
        check_join_laws(named.domain, diagram.cells(), joined, tolerance);
        const bool exact = diagram.precision() == Precision::float64;
        if (exact && named.domain.kind() != DomainKind::surface) CHECK(interior_count(joined) == 0);
      }
    }
  }
}

TEST_CASE("the facets around a missing piece stay, and the cell stays closed") {
  const std::vector<double> plane = {0.4, 0.5, 0.6, 0.5}, space = {0.4, 0.5, 0.5, 0.6, 0.5, 0.5};
  Random random(1);
  const Domain comb_shape = Domain::polygon(comb(3)), cube = volume_of(cube_tetrahedra(1, 0, random));
  for (const Domain& domain : {comb_shape, cube}) {
    const SeedsView seeds{domain.dimension(), domain.dimension() == 2 ? plane : space, {}};
    const Cells whole = cells_by_definition(domain, seeds);
    REQUIRE(interior_count(join(domain, whole)) == 0);
    for (std::uint64_t p = 0; p < whole.piece_count(); ++p) {
      const Cells cells = without_piece(whole, p);
      const JoinedCells joined = join(domain, cells);
      check_join_laws(domain, cells, joined, 1e-12);
      const auto begin = whole.border.begin();
      const auto facets = std::count_if(begin + static_cast<std::ptrdiff_t>(whole.face_offset[p]),
                                        begin + static_cast<std::ptrdiff_t>(whole.face_offset[p + 1]),
                                        [](const Border& b) { return b.kind == Border::Kind::interior; });
      CHECK(interior_count(joined) == static_cast<std::size_t>(facets));
    }
  }
}
