// Periodic boxes: cells compared with those among all copies, walls, and transport.
#include <doctest/doctest.h>

#include <cmath>
#include <powercell/diagram.hpp>
#include <powercell/sampling.hpp>
#include <powercell/transport.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

const std::array<double, 2> low{-1, 2}, high{2, 4};

Domain box() {
  return Domain::box(low, high);
}

Domain periodic() {
  return Domain::periodic_box(low, high);
}

SeedArray seeds_in_box(std::size_t n, WeightRange range, Random& random) {
  SeedArray seeds = scatter(Distribution::white, n, 2, {{low[0], low[1], 0}, {high[0], high[1], 0}}, random);
  set_weights(seeds, range, spacing(6, n, 2), random);
  return seeds;
}

/// Measures among all nine copies of the box, in a domain large enough for every cell.
Measures among_all_copies(const SeedArray& seeds) {
  SeedArray copies{2, seeds.positions, seeds.weights};
  for (int a = -1; a <= 1; ++a)
    for (int b = -1; b <= 1; ++b)
      for (std::size_t i = 0; (a != 0 || b != 0) && i < seeds.size(); ++i)
        copies.push({seeds.coordinate(i, 0) + 3 * a, seeds.coordinate(i, 1) + 2 * b}, seeds.weights[i]);
  const std::array<double, 2> far_low{-4, 0}, far_high{5, 6};
  const Setup& setup = main_setups().front();
  return measure(setup.device, Domain::box(far_low, far_high), copies.view(), setup.options);
}

}  // namespace

TEST_CASE("periodic cells agree with those among all copies") {
  INFO(replay_hint());
  Random random(test_seed());
  const Setup& setup = main_setups().front();
  for (const std::size_t n : {1u, 2u, 7u, 300u})
    for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
      INFO(n << " seeds, weights " << name(range));
      const SeedArray seeds = seeds_in_box(n, range, random);
      Diagram diagram(setup.device, periodic(), setup.options);
      diagram.set_seeds(seeds.view());
      const Measures found = diagram.measures(), expected = among_all_copies(seeds);
      REQUIRE(found.mass.size() == n);
      CHECK(found.total() == doctest::Approx(6).epsilon(1e-12));
      for (std::size_t i = 0; i < n; ++i) {
        CHECK(std::abs(found.mass[i] - expected.mass[i]) < 1e-11);
        CHECK(std::abs(found.second_moment[i] - expected.second_moment[i]) < 1e-10);
      }
    }
}

TEST_CASE("one heavy seed: the margin grows until the areas sum to the area of the box") {
  Random random(test_seed());
  SeedArray seeds = seeds_in_box(400, WeightRange::W0, random);
  seeds.weights[0] = 0.8;  // a disc of radius 0.9, cut by copies farther away than three spacings
  const Setup& setup = main_setups().front();
  Diagram diagram(setup.device, periodic(), setup.options);
  diagram.set_seeds(seeds.view());
  const Measures expected = among_all_copies(seeds);
  CHECK(expected.mass[0] > 1);
  for (std::size_t i = 0; i < seeds.size(); ++i)
    CHECK(std::abs(diagram.measures().mass[i] - expected.mass[i]) < 1e-11);
}

TEST_CASE("single precision: cuts by copies beyond the first margin are not lost in rounding") {
  Random random(5);
  Setup setup = main_setups().front();
  setup.options.precision = Precision::float32;
  SeedArray seeds = seeds_in_box(400, WeightRange::W0, random);
  seeds.coordinate(0, 0) = 0.5;
  seeds.coordinate(0, 1) = 3;
  for (int step = 0; step < 20; ++step) {
    // Discs of radius 0.933 to 0.943 in a box of height 2: copies cut off 1e-5 of the cell.
    seeds.weights[0] = 0.87 + 0.001 * step;
    CAPTURE(seeds.weights[0]);
    Diagram diagram(setup.device, periodic(), setup.options);
    diagram.set_seeds(seeds.view());
    const Measures expected = among_all_copies(seeds);
    double off = 0;
    for (std::size_t i = 0; i < seeds.size(); ++i)
      off = std::max(off, std::abs(diagram.measures().mass[i] - expected.mass[i]));
    CHECK(off < 1e-6);
    CHECK(expected.mass[0] > 2);
  }
}

TEST_CASE("walls of periodic cells are symmetric, and seeds outside the box stand for their copies inside") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = seeds_in_box(50, WeightRange::W1, random);
  const Setup& setup = main_setups().front();
  Diagram diagram(setup.device, periodic(), setup.options), moved(setup.device, periodic(), setup.options);
  diagram.set_seeds(seeds.view());
  SeedArray far = seeds;
  for (std::size_t i = 0; i < far.size(); ++i) {
    far.coordinate(i, 0) += 3 * static_cast<double>(i % 4);
    far.coordinate(i, 1) -= 2 * static_cast<double>(i % 3);
  }
  moved.set_seeds(far.view());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    CHECK(std::abs(diagram.measures().mass[i] - moved.measures().mass[i]) < 1e-11);
    REQUIRE(diagram.measures().status[i] == moved.measures().status[i]);
    for (std::size_t k = 0; k < 2 && diagram.measures().status[i] == SeedStatus::ok; ++k)
      CHECK(std::abs((diagram.measures().centroid[2 * i + k] - seeds.positions[2 * i + k]) -
                     (moved.measures().centroid[2 * i + k] - far.positions[2 * i + k])) < 1e-10);
  }
  const Adjacency& here = diagram.adjacency();
  std::size_t met = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (std::uint64_t k = here.offset[i]; k < here.offset[i + 1]; ++k) {
      const std::uint32_t j = here.neighbor[k];
      double back = 0;
      for (std::uint64_t other = here.offset[j]; other < here.offset[j + 1]; ++other)
        if (here.neighbor[other] == i && here.shift[other][0] == -here.shift[k][0] &&
            here.shift[other][1] == -here.shift[k][1])
          back = here.wall[other];
      CHECK(back == here.wall[k]);
      ++met;
    }
  CHECK(met > 4 * seeds.size());
}

TEST_CASE("transport in a periodic box converges, and is invariant under translation of the seeds") {
  INFO(replay_hint());
  Random random(test_seed());
  const Setup& setup = main_setups().front();
  TransportOptions options;
  options.diagram = setup.options;
  options.periodic = true;
  options.tolerance = 1e-10;
  for (const std::size_t n : {3u, 200u}) {
    SeedArray seeds = seeds_in_box(n, WeightRange::W0, random);
    const TransportResult here = transport(setup.device, box(), seeds.view(), {}, options);
    translate(seeds, {0.7, -0.9, 0});
    const TransportResult there = transport(setup.device, box(), seeds.view(), {}, options);
    CHECK(here.converged);
    CHECK(there.converged);
    CHECK(here.newton_steps() < 15);
    CHECK(here.primal == doctest::Approx(here.dual).epsilon(1e-9));
    for (std::size_t i = 0; i < n; ++i) {
      CHECK(here.mass[i] == doctest::Approx(6.0 / static_cast<double>(n)).epsilon(1e-9));
      CHECK(std::abs(here.weights[i] - there.weights[i]) < 1e-8);
    }
  }
}

TEST_CASE("copies of one seed are merged, and seeds are mapped into the box from afar") {
  const Setup& setup = main_setups().front();
  TransportOptions options;
  options.diagram = setup.options;
  options.periodic = true;
  // The box is [-1, 2] x [2, 4].
  const std::vector<double> positions{-1, 3, 2, 3, 0.5, 2.5, 5, 1};
  const TransportResult found = transport(setup.device, box(), {2, positions, {}}, {}, options);
  CHECK(found.converged);
  CHECK(found.merged == 2);
  CHECK(found.merged_with == std::vector<std::uint32_t>{0, 0, 2, 0});
  CHECK(found.mass[0] == doctest::Approx(4.5).epsilon(1e-5));
  const std::vector<double> far{-1e6 - 1, 1e6, -1 - 1e-18, 4};
  const std::vector<double> inside = periodic().wrapped(far);
  for (std::size_t k = 0; k < inside.size(); ++k) {
    CHECK(inside[k] >= low[k % 2]);
    CHECK(inside[k] < high[k % 2]);
  }
}

TEST_CASE("transport and sampling in periodic boxes of space and in lattices") {
  const Setup& setup = main_setups().front();
  const std::vector<double> skew{1, 0, 0, 0.3, 1.1, 0, -0.2, 0.4, 0.9}, flat_skew{1, 0, 0.5, 0.8};
  for (const Domain& domain : {unit_box(3), Domain::lattice(skew), Domain::lattice(flat_skew)}) {
    SamplingOptions options;
    options.periodic = domain.dimension() == 3 && !domain.is_periodic();
    options.diagram = setup.options;
    options.iterations = 5;
    options.mode = SamplingMode::quantise;
    options.movement = 0;
    const SamplingResult found = sample(setup.device, domain, 40, options);
    CHECK(found.converged);
    CHECK(found.steps.back().energy < 0.95 * found.steps.front().energy);
    for (const double mass : found.mass) CHECK(mass == doctest::Approx(domain.measure() / 40).epsilon(1e-5));
    // The weights give these masses in a diagram of the periodic domain, and the centroids near the points.
    const Domain torus = options.periodic
                             ? Domain::periodic_box(std::array{0.0, 0.0, 0.0}, std::array{1.0, 1.0, 1.0})
                             : domain;
    Diagram diagram(setup.device, torus, setup.options);
    diagram.set_seeds({torus.dimension(), found.positions, found.weights});
    for (const double mass : diagram.measures().mass)
      CHECK(mass == doctest::Approx(domain.measure() / 40).epsilon(1e-5));
  }
}

TEST_CASE("domains and densities that cannot be periodic are refused") {
  const Setup& setup = main_setups().front();
  const auto code = [&](const Domain& domain, const Density& density) {
    TransportOptions options;
    options.periodic = true;
    options.density = density;
    try {
      TransportSolver solver(setup.device, domain, options);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::internal;
  };
  const Density one = Density::constant(1);
  CHECK(code(Domain::volume(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                            std::vector<std::uint32_t>{0, 1, 2, 3}),
             one) == ErrorCode::unsupported);
  CHECK(code(Domain::polygon(square_with_holes()), one) == ErrorCode::unsupported);
  CHECK(code(Domain::polygon(std::vector<PolygonPart>{{{{0, 0}, {1, 0}, {0, 1}}, {}}}), one) ==
        ErrorCode::unsupported);
  CHECK(code(box(), Density::formula("1+x*x")) == ErrorCode::unsupported);
}
