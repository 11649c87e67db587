// Bisectors at tiny angles to the facets that they cut: the ends of a wall move by rounding over the sine of
// the angle, differently on its two sides. Verification and certificate allow for it.
#include <doctest/doctest.h>

#include <cmath>
#include <powercell/verify.hpp>

#include "lib/verify/angles.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

Vector unit(const Vector& a) {
  return (1 / norm(a)) * a;
}

/// A point of a facet, its normal and a direction in it.
struct Place {
  Vector point, normal, along;
  double size;  // of the region
};

Vector any_of(const Corners& corners, Random& random) {
  Vector sum{};
  long double weights = 0;
  for (const Vector& corner : corners) {
    const long double weight = random.uniform(0.01, 1);
    sum = sum + weight * corner;
    weights += weight;
  }
  return (1 / weights) * sum;
}

/// In a face of a tetrahedron or box, an edge of a polygon, or an edge or triangle of a surface.
Place any_place(const Domain& domain, Random& random) {
  const RegionMesh& mesh = domain.mesh();
  const Corners region = corners_of(mesh, random.index(mesh.region_count()));
  const std::vector<Corners> facets = facets_of(mesh, region);
  Corners facet = facets[random.index(facets.size())];
  Vector normal{};
  if (facet.size() > 2) {
    normal = normal_of(facet);
  } else if (domain.kind() == DomainKind::surface && random.index(3) == 0) {
    facet = region;
    normal = normal_of(region);
  } else {
    const Vector up = domain.kind() == DomainKind::surface
                          ? Vector{random.normal(), random.normal(), random.normal()}
                          : Vector{0, 0, 1};
    normal = cross(facet[1] - facet[0], up);
  }
  const Vector point = any_of(facet, random);
  return {point, unit(normal), unit(facet[1] - facet[0]), static_cast<double>(norm(region[1] - region[0]))};
}

/// Two seeds whose bisector crosses the facet there at this angle, sometimes with others around.
SeedArray seeds_at(const Place& place, double angle, const Domain& domain, Random& random) {
  const int d = domain.dimension();
  SeedArray seeds{d, {}, {}};
  const Vector across = place.normal + angle * place.along;
  const double far = place.size * random.uniform(0.01, 0.5);
  for (const double side : {far, -far}) {
    const Vector seed = place.point + side * across;
    for (std::size_t c = 0; c < static_cast<std::size_t>(d); ++c)
      seeds.positions.push_back(static_cast<double>(seed[c]));
  }
  if (random.index(2) == 0) {
    const SeedArray more = seeds_for(domain, Distribution::white, WeightRange::W0, 5, random);
    seeds.positions.insert(seeds.positions.end(), more.positions.begin(), more.positions.end());
  }
  seeds.weights.assign(seeds.positions.size() / static_cast<std::size_t>(d), 0);
  return seeds;
}

}  // namespace

TEST_CASE("bisectors nearly parallel to facets, edges and triangles of the domain obey the laws") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const auto& list : {polygon_domains(), surface_domains(), volume_domains(), box_domains()})
    for (const NamedDomain& named : list)
      for (const Setup& setup : all_setups()) {
        Options options = setup.options;
        options.certify = true;
        Diagram diagram(setup.device, named.domain, options);
        for (int trial = 0; trial < number_of_inputs(15, 60); ++trial) {
          const double angle = std::pow(10, random.uniform(-14, -1));
          const SeedArray seeds = seeds_at(any_place(named.domain, random), angle, named.domain, random);
          INFO(setup.name << ", domain " << named.name << ", trial " << trial << ", angle " << angle);
          diagram.set_seeds(seeds.view());
          REQUIRE_NOTHROW(diagram.adjacency());
          for (const LawCheck& check : verify(diagram, seeds.view(), {20, test_seed()})) {
            INFO(check.law << ": " << check.value << " of " << check.tolerance << "; " << check.detail);
            CHECK(check.passed);
          }
        }
      }
}
