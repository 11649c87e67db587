// The tolerance of the sum of measures depends on the domain's shape and the seeds' distance.
#include "lib/verify/partition.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <powercell/verify.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

double gradient_of(const Domain& domain) {
  return static_cast<double>(measure_gradient(domain.mesh()));
}

const LawCheck& partition_of(const std::vector<LawCheck>& checks) {
  const LawCheck& check = checks.front();
  REQUIRE(check.law.starts_with("partition"));
  return check;
}

}  // namespace

TEST_CASE("gradients of measures agree with closed forms") {
  // The gradient at a corner of a square is half a diagonal; at a corner of a cube it is a quarter of three
  // facets.
  CHECK(gradient_of(unit_box(2)) == doctest::Approx(4 * std::sqrt(0.5)));
  CHECK(gradient_of(unit_box(3)) == doctest::Approx(8 * std::sqrt(3.0) / 4));
  const std::vector<double> corner{0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
  const Domain tetrahedron = Domain::volume(corner, std::vector<std::uint32_t>{0, 1, 2, 3});
  CHECK(gradient_of(tetrahedron) == doctest::Approx((3 * 2 + 2 * std::sqrt(3.0)) / 3));
  // A flat sheet counts as its polygon; a closed surface has twice its mean curvature.
  const std::vector<double> sheet{0, 0, 5, 1, 0, 5, 1, 1, 5, 0, 1, 5};
  CHECK(gradient_of(Domain::surface(sheet, std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3})) ==
        doctest::Approx(4 * std::sqrt(0.5)));
  CHECK(gradient_of(surface_of(icosphere(4))) == doctest::Approx(8 * std::numbers::pi).epsilon(0.05));
}

TEST_CASE("gradients at inner corners of a volume are 0") {
  Random random(test_seed());
  const double gradient = gradient_of(volume_of(cube_tetrahedra(8, 0.2, random)));
  CHECK(gradient > gradient_of(unit_box(3)));
  CHECK(gradient < 6);
}

TEST_CASE("boxes far longer than thick obey the laws, with seeds as far away as they are long") {
  for (const double thick : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const Domain domain = Domain::box(std::vector<double>{0, 0, 0}, std::vector<double>{thick, 1, 1});
    SeedArray seeds{3, {}, {}};
    seeds.push({1, 0.3, 0.6}, 0);
    for (Setup setup : main_setups()) {
      INFO(setup.name << ", " << thick);
      // In single precision, nothing is left of a thickness below the rounding of the distance.
      if (setup.options.precision == Precision::float32 && thick < 1e-5) continue;
      setup.options.certify = true;
      Diagram diagram(setup.device, domain, setup.options);
      diagram.set_seeds(seeds.view());
      const std::vector<LawCheck> checks = verify(diagram, seeds.view(), {20, test_seed()});
      for (const LawCheck& check : checks) {
        INFO(check.law << ": " << check.value << " of " << check.tolerance << "; " << check.detail);
        CHECK(check.passed);
      }
      const double unit = setup.options.precision == Precision::float32 ? 0x1p-24 : 0x1p-53;
      CHECK(partition_of(checks).value <= 4 * unit / thick);
      CHECK(partition_of(checks).tolerance <= 1e5 * unit / thick);
    }
  }
}
