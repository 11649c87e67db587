// Random seeds: every device x precision x provider x domain x distribution x weights.
#include <doctest/doctest.h>

#include "tests/diagram/check.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

void check_domains(const std::vector<NamedDomain>& domains, std::size_t n) {
  INFO(replay_hint());
  for (const NamedDomain& named : domains)
    for (const Distribution distribution : {Distribution::white, Distribution::blue, Distribution::cluster})
      for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
        // Each case has random numbers of its own, so that it can be replayed alone.
        Random random(test_seed() * 1000003 + static_cast<std::uint64_t>(distribution) * 8 +
                      static_cast<std::uint64_t>(range));
        INFO(named.name << ", " << name(distribution) << ' ' << name(range));
        check_everywhere(named.domain, seeds_for(named.domain, distribution, range, n, random),
                         Position::general);
      }
}

}  // namespace

TEST_CASE("diagrams of polygons agree with brute force") {
  check_domains(polygon_domains(), 120);
}
TEST_CASE("diagrams of surfaces agree with brute force") {
  check_domains(surface_domains(), 120);
}
TEST_CASE("diagrams of volumes agree with brute force") {
  check_domains(volume_domains(), 50);
}
TEST_CASE("diagrams of boxes agree with brute force") {
  check_domains(box_domains(), 150);
}
