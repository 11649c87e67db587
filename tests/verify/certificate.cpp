// The certificate holds for results of the library, and refuses tampered ones.
#include "lib/verify/certificate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <powercell/diagram.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("certificates of ordinary and degenerate diagrams hold, on every kind of domain") {
  Random random(test_seed());
  const std::vector<NamedDomain> kinds = {{"islands", Domain::polygon(islands())},
                                          {"torus", surface_of(torus(12, 7))},
                                          {"ball", volume_of(ball_tetrahedra(0))},
                                          {"cube", unit_box(3)}};
  for (const NamedDomain& named : kinds)
    for (Setup setup : main_setups()) {
      INFO(named.name << ", " << setup.name);
      setup.options.certify = true;
      Diagram diagram(setup.device, named.domain, setup.options);
      diagram.set_seeds(seeds_for(named.domain, Distribution::white, WeightRange::W2, 400, random).view());
      CHECK_NOTHROW(diagram.compute(true, true));
      CHECK(diagram.timings().certify > 0);
      diagram.set_seeds(grid(named.domain.dimension() == 2 ? 8 : 4, named.domain.dimension(),
                             Box{named.domain.low(), named.domain.high()})
                            .view());
      CHECK_NOTHROW(diagram.compute(true, false));
      diagram.set_seeds({named.domain.dimension(), {}, {}});
      CHECK_NOTHROW(diagram.measures());
    }
}

TEST_CASE("certificates hold where power distances differ by less than rounding") {
  // The middle one of three is hidden by a weight far below the rounding of distances.
  const double h = 1e-17;
  for (Setup setup : main_setups()) {
    setup.options.certify = true;
    for (int k = 0; k < 6; ++k) {
      SeedArray seeds{2, {}, {}};
      for (int j = 0; j < 3; ++j) {
        const int at = (j + k) % 3;
        seeds.push({at * h, 0.5 + 0.01 * k}, at == 1 ? -4 * h * h : 0);
      }
      Diagram diagram(setup.device, unit_box(2), setup.options);
      diagram.set_seeds(seeds.view());
      CHECK_NOTHROW(diagram.measures());
      CHECK(diagram.measures().status[static_cast<std::size_t>((4 - k % 3) % 3)] == SeedStatus::hidden);
    }
  }
}

TEST_CASE("certificates of cells far from their seeds hold, and wrong ones are refused nevertheless") {
  Random random(test_seed());
  for (const double far : {0x1p18, 0x1p22}) {
    // Voronoi cells of seeds y, as those of y + far with weights 2 far.y.
    SeedArray seeds = scatter(Distribution::white, 300, 2, {}, random);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const double y = std::ldexp(std::floor(std::ldexp(seeds.coordinate(i, 0), 20)), -20);
      seeds.coordinate(i, 0) = y + far;
      seeds.weights[i] = 2 * far * y;
    }
    for (Setup setup : all_setups()) {
      INFO(setup.name << ", " << far);
      setup.options.certify = true;
      Diagram diagram(setup.device, unit_box(2), setup.options);
      diagram.set_seeds(seeds.view());
      CHECK_NOTHROW(diagram.measures());
      if (setup.options.precision == Precision::float32) continue;
      Measures measures = diagram.measures();
      measures.mass[7] *= 1.1;
      const SeedSet set = make_seed_set(seeds.view(), 2, 1);
      CHECK_THROWS_AS(require_certificate({unit_box(2), set, set, measures, nullptr, false, 1}), Error);
    }
  }
}

TEST_CASE("certificates of impossible results are refused and name the seed") {
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 300, 3, random);
  const Domain domain = unit_box(3);
  Diagram diagram(test_device(), domain, {});
  diagram.set_seeds(seeds.view());
  diagram.compute(true, false);
  const SeedSet set = make_seed_set(seeds.view(), 3, 1);
  const auto refusal = [&](const std::function<void(Measures&, Adjacency&)>& tamper) -> std::string {
    Measures measures = diagram.measures();
    Adjacency adjacency = diagram.adjacency();
    tamper(measures, adjacency);
    try {
      require_certificate({domain, set, set, measures, &adjacency, false, 2});
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::internal);
      return error.what();
    }
    return "";
  };
  CHECK(refusal([](Measures&, Adjacency&) {}) == "");
  CHECK(refusal([](Measures& m, Adjacency&) { m.mass[7] *= 1.001; }).find("measure") != std::string::npos);
  CHECK(refusal([](Measures& m, Adjacency&) {
          m.mass[8] += 2 * m.mass[7];
          m.mass[7] *= -1;
        }).find("seed 7") != std::string::npos);
  CHECK(refusal([](Measures& m, Adjacency&) { m.centroid[3 * 41 + 1] = 1.5; }).find("seed 41") !=
        std::string::npos);
  CHECK(refusal([](Measures& m, Adjacency&) {
          m.second_moment[5] = std::numeric_limits<double>::quiet_NaN();
        }).find("seed 5 ") != std::string::npos);
  CHECK(refusal([](Measures&, Adjacency& a) { a.asymmetry = 0.01; }).find("two sides") != std::string::npos);
  CHECK(refusal([](Measures&, Adjacency& a) {
          a.asymmetry = 0.01;
          a.asymmetric = {9, a.neighbor[a.offset[9]]};
        }).find("of seeds 9 and ") != std::string::npos);
  // With all seeds but one marked hidden, most points have an owner without a cell.
  CHECK(refusal([](Measures& m, Adjacency&) {
          for (std::size_t i = 1; i < m.mass.size(); ++i) {
            m.mass[0] += m.mass[i];
            m.mass[i] = m.second_moment[i] = 0;
            m.status[i] = SeedStatus::hidden;
          }
        }).find("owns the point") != std::string::npos);
}
