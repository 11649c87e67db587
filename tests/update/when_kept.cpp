// When a diagram is kept, and what a loop that cannot be repaired costs.
#include <doctest/doctest.h>

#include <powercell/diagram.hpp>
#include <powercell/error.hpp>
#include <powercell/log.hpp>
#include <powercell/transport.hpp>
#include <string>

#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

Options keeping() {
  Options options;
  options.keep_mesh = true;
  return options;
}

/// Counts lines of the log.
class LogCounter {
 public:
  explicit LogCounter(std::string text) : text_(std::move(text)) {
    set_log([this](LogLevel, std::string_view line) { count_ += line.find(text_) != line.npos ? 1 : 0; });
  }
  ~LogCounter() { set_log({}); }
  LogCounter(const LogCounter&) = delete;
  LogCounter& operator=(const LogCounter&) = delete;
  std::size_t count() const { return count_; }

 private:
  std::string text_;
  std::size_t count_ = 0;
};

/// One step of a loop. \return how many cells were taken from the mesh
std::uint64_t reused_after(Diagram& diagram, SeedArray& seeds, double change, Random& random) {
  for (double& w : seeds.weights) w += random.uniform(-change, change);
  diagram.set_weights(seeds.weights);
  diagram.compute(true, false);
  return diagram.timings().reused;
}

}  // namespace

TEST_CASE("a diagram is kept from the second change on") {
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 500, 3, random);
  Diagram diagram(test_device(), unit_box(3), keeping());
  diagram.set_seeds(seeds.view());
  diagram.compute(true, false);
  CHECK(diagram.timings().reused == 0);
  CHECK(reused_after(diagram, seeds, 1e-5, random) == 0);
  CHECK(reused_after(diagram, seeds, 1e-5, random) == 500);
  CHECK(reused_after(diagram, seeds, 1e-5, random) == 500);
  diagram.set_seeds(seeds.view());
  diagram.measures();
  CHECK(diagram.timings().reused == 500);
  diagram.adjacency();
  CHECK(diagram.timings().reused == 500);
  diagram.cells();
  CHECK(diagram.timings().reused == 0);
  CHECK(reused_after(diagram, seeds, 1e-5, random) == 500);
  const SeedArray other = random_seeds(Distribution::white, WeightRange::W1, 400, 3, random);
  diagram.set_seeds(other.view());
  diagram.measures();
  CHECK(diagram.timings().reused == 0);
}

TEST_CASE("no mesh is kept unless it is asked for") {
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 50, 2, random);
  Diagram diagram(test_device(), unit_box(2));
  diagram.set_seeds(seeds.view());
  diagram.measures();
  for (int k = 0; k < 3; ++k) CHECK(reused_after(diagram, seeds, 1e-6, random) == 0);
}

TEST_CASE("a stopped update goes on") {
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 200, 3, random);
  int calls = 0, stop_at = 0;
  Options options = keeping();
  options.progress = [&](double) { return ++calls != stop_at; };
  Diagram diagram(test_device(), unit_box(3), options);
  diagram.set_seeds(seeds.view());
  diagram.measures();
  for (int k = 0; k < 2; ++k) reused_after(diagram, seeds, 1e-5, random);
  for (stop_at = 1; stop_at <= 3; ++stop_at) {
    CAPTURE(stop_at);
    for (double& w : seeds.weights) w += random.uniform(-1e-5, 1e-5);
    diagram.set_weights(seeds.weights);
    calls = 0;
    CHECK_THROWS_AS(diagram.measures(), Error);
    CHECK(calls == stop_at);
    diagram.compute(true, false);
    CHECK(diagram.timings().reused == 200);
    Diagram fresh(test_device(), unit_box(3));
    fresh.set_seeds(seeds.view());
    CHECK(diagram.adjacency().neighbor == fresh.adjacency().neighbor);
  }
}

TEST_CASE("what cannot be kept is computed anew") {
  Random random(test_seed());
  Options fast = keeping();
  fast.decisions = Decisions::fast;
  const std::vector<std::pair<Domain, Options>> cases{
      {unit_box(3), fast},
      {volume_of(ball_tetrahedra(0)), keeping()},
      {Domain::polygon(islands()), keeping()},
      {Domain::periodic_box(std::vector<double>{0, 0}, std::vector<double>{1, 1}), keeping()}};
  for (const auto& [domain, options] : cases) {
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 50, domain.dimension(), random);
    Diagram diagram(test_device(), domain, options);
    diagram.set_seeds(seeds.view());
    diagram.measures();
    for (int k = 0; k < 3; ++k) CHECK(reused_after(diagram, seeds, 1e-6, random) == 0);
  }
}

TEST_CASE("after failures a mesh is tried more and more seldom") {
  SeedArray seeds = grid(5, 3);
  Diagram diagram(test_device(), unit_box(3), keeping());
  diagram.set_seeds(seeds.view());
  diagram.measures();
  const LogCounter failures("the dual mesh is of no use");
  for (int k = 0; k < 40; ++k) {
    diagram.set_weights(seeds.weights);
    diagram.measures();
  }
  // Of the changes 2, 4, 7, 12, 21 and 38.
  CHECK(failures.count() == 6);
}

TEST_CASE("selected cells and certified diagrams do without a mesh, or with it") {
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 300, 2, random);
  Options options = keeping();
  options.certify = true;
  Diagram certified(test_device(), unit_box(2), options), selected(test_device(), unit_box(2), keeping());
  for (Diagram* diagram : {&certified, &selected}) {
    diagram->set_seeds(seeds.view());
    diagram->measures();
    reused_after(*diagram, seeds, 1e-6, random);
    CHECK(reused_after(*diagram, seeds, 1e-6, random) == 300);
  }
  selected.set_seeds(seeds.view());
  selected.select(std::vector<std::uint32_t>{3, 77});
  CHECK(selected.measures().mass.size() == 2);
  CHECK(selected.timings().reused == 0);
  selected.select_all();
  CHECK(selected.measures().mass.size() == 300);
  CHECK(selected.boundary_walls().offset.size() == 301);
}

TEST_CASE("transport goes on from the kept mesh") {
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 2000, 3, random);
  const LogCounter kept("from the kept mesh");
  TransportOptions options;
  options.diagram.keep_mesh = true;
  TransportSolver solver(test_device(), unit_box(3), options);
  solver.set_seeds(seeds.view());
  CHECK(solver.solve().converged);
  CHECK(kept.count() > 2);
}
