// Each law finds its fault in results that were correct before.
#include <doctest/doctest.h>

#include <limits>

#include "lib/verify/laws.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Results of a diagram of white seeds in the unit square or cube, to be modified.
struct Results {
  explicit Results(int dimension)
      : domain(unit_box(dimension)),
        rounding(extent_of(domain), (seeds = make_seeds(dimension)).view(), Precision::float64) {
    Setup setup = main_setups().front();
    setup.options.precision = Precision::automatic;
    Diagram diagram(setup.device, domain, setup.options);
    diagram.set_seeds(seeds.view());
    measures = diagram.measures();
    adjacency = diagram.adjacency();
    cells = diagram.cells();
    if (diagram.precision() == Precision::float32)
      rounding = Rounding(extent_of(domain), seeds.view(), Precision::float32);
  }
  static SeedArray make_seeds(int dimension) {
    Random random(test_seed());
    return random_seeds(Distribution::white, WeightRange::W1, 60, dimension, random);
  }

  SeedArray seeds;
  Domain domain;
  Rounding rounding;
  Measures measures;
  Adjacency adjacency;
  Cells cells;

  LawCheck owners() const {
    return check_owners(random_points(domain.mesh(), 300, 1), domain.mesh(), cells, rounding);
  }
  bool pieces_pass() const {
    const std::vector<LawCheck> checks = check_pieces(measures, cells, rounding);
    return checks[0].passed && checks[1].passed;
  }
  LawCheck statuses() const { return check_statuses(measures, cells, seeds.view()); }
};

}  // namespace

TEST_CASE("a moved vertex breaks the law of pieces") {
  for (const int d : {2, 3}) {
    Results results(d);
    CHECK(results.pieces_pass());
    results.cells.vertices[10] += 1e-4;
    CHECK_FALSE(results.pieces_pass());
  }
}

TEST_CASE("a wrong centroid breaks the law of centroids, and so does NaN") {
  Results results(2);
  const double right = results.measures.centroid[7];
  for (const double wrong : {right + 1e-4, std::numeric_limits<double>::quiet_NaN()}) {
    results.measures.centroid[7] = wrong;
    const std::vector<LawCheck> checks = check_pieces(results.measures, results.cells, results.rounding);
    CHECK(checks[0].passed);
    CHECK_FALSE(checks[1].passed);
    CHECK(checks[1].detail.find("seed 3") != std::string::npos);
  }
}

TEST_CASE("cells of seeds with other weights break the law of ownership") {
  for (const int d : {2, 3}) {
    Results results(d);
    CHECK(results.owners().passed);
    results.seeds.weights[5] += 0.1;
    const LawCheck check = results.owners();
    CHECK_FALSE(check.passed);
    CHECK(check.value > check.tolerance);
    CHECK(check.detail.find("belongs to seed 5 ") != std::string::npos);
  }
}

TEST_CASE("cells of seeds with other weights break the laws of bisectors and vertices") {
  for (const int d : {2, 3}) {
    Results results(d);
    const auto check = [&] {
      return std::pair{check_bisectors(results.cells, results.rounding),
                       check_vertices(results.cells, results.rounding, {300, test_seed()})};
    };
    const auto [bisectors, vertices] = check();
    CHECK(bisectors.passed);
    CHECK(vertices.passed);
    results.seeds.weights[5] += 0.1;
    const auto [wrong_bisectors, wrong_vertices] = check();
    CHECK_FALSE(wrong_bisectors.passed);
    CHECK_FALSE(wrong_vertices.passed);
    CHECK(wrong_vertices.detail.find("belongs to seed 5") != std::string::npos);
  }
}

TEST_CASE("saved diagrams whose arrays do not fit together are refused") {
  for (const int d : {2, 3}) {
    const Results results(d);
    const DomainKind kind = results.domain.kind();
    const JoinedCells right = join(results.domain, results.cells);
    const auto passes = [&](const Measures& measures, const JoinedCells& cells) {
      for (const LawCheck& check :
           verify({kind, Precision::float32, results.seeds.view(), measures, cells}, {20, test_seed()}))
        if (!check.passed) return false;
      return true;
    };
    CHECK(passes(results.measures, right));
    Measures without_centroids = results.measures;
    without_centroids.centroid.clear();
    CHECK(passes(without_centroids, right));
    Measures measures = results.measures;
    measures.mass.pop_back();
    CHECK_THROWS_AS(passes(measures, right), Error);
    measures = results.measures;
    measures.centroid.pop_back();
    CHECK_THROWS_AS(passes(measures, right), Error);
    const auto refused = [&](auto&& spoil) {
      JoinedCells cells = right;
      spoil(cells);
      CHECK_THROWS_AS(passes(results.measures, cells), Error);
    };
    refused([](JoinedCells& cells) { cells.dimension = 5 - cells.dimension; });
    refused([](JoinedCells& cells) { cells.vertices.pop_back(); });
    refused([](JoinedCells& cells) { cells.vertex_offset[1] = cells.vertex_offset[3]; });
    refused([](JoinedCells& cells) { cells.face_offset.pop_back(); });
    refused([](JoinedCells& cells) { cells.loop[2] = 1000000; });
    refused([](JoinedCells& cells) { cells.loop_offset[1] = 2; });
    refused([](JoinedCells& cells) {
      (cells.cell_dimension == 3 ? cells.face_border : cells.edge_border).pop_back();
    });
    refused([](JoinedCells& cells) {
      (cells.cell_dimension == 3 ? cells.face_border : cells.edge_border)[0] = {Border::Kind::wall, 60};
    });
  }
}

TEST_CASE("one-sided and unequal walls break the law of symmetry") {
  const Results results(2);
  CHECK(check_walls(results.adjacency, &results.domain.mesh(), results.rounding).passed);
  Adjacency uneven = results.adjacency;
  uneven.wall[3] *= 1 + 1e-3;
  CHECK_FALSE(check_walls(uneven, &results.domain.mesh(), results.rounding).passed);
  Adjacency lopsided = results.adjacency;
  lopsided.asymmetry = 0.01;
  CHECK_FALSE(check_walls(lopsided, &results.domain.mesh(), results.rounding).passed);
  for (std::uint32_t i = 0; i + std::size_t{1} < lopsided.offset.size(); ++i)
    for (std::uint64_t e = lopsided.offset[i]; e < lopsided.offset[i + 1]; ++e) {
      lopsided.asymmetric = {i, lopsided.neighbor[e]};
      const LawCheck check = check_walls(lopsided, &results.domain.mesh(), results.rounding);
      CHECK_FALSE(check.passed);
      CHECK(check.detail.find("of seeds " + std::to_string(i) + " and ") != std::string::npos);
    }
  Adjacency descending = results.adjacency;
  std::swap(descending.neighbor[0], descending.neighbor[1]);
  CHECK_FALSE(check_walls(descending, &results.domain.mesh(), results.rounding).passed);
}

TEST_CASE("statuses that contradict the measures or positions are found") {
  Results results(3);
  CHECK(results.statuses().passed);
  const Measures right = results.measures;
  results.measures.status[4] = SeedStatus::duplicate;
  CHECK(results.statuses().detail.find("seed 4 ") == 0);
  results.measures = right;
  results.measures.status[8] = SeedStatus::hidden;
  CHECK_FALSE(results.statuses().passed);
  results.measures = right;
  for (std::size_t k = 0; k < 3; ++k)
    results.seeds.positions[3 * 20 + k] = results.seeds.positions[3 * 10 + k];
  CHECK(results.statuses().value == 1);  // one of the two should be a duplicate
}

TEST_CASE("random points are uniform, in their region and reproducible") {
  Random random(test_seed());
  const Domain domain = volume_of(cube_tetrahedra(2, 0.2, random));
  const std::vector<Sample> samples = random_points(domain.mesh(), 20000, 7);
  const std::vector<Sample> again = random_points(domain.mesh(), 20000, 7);
  Vector sum{};
  std::size_t low = 0;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    CHECK(samples[s].point == again[s].point);
    sum = sum + samples[s].point;
    low += samples[s].point[0] < 0.25L;
  }
  for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(static_cast<double>(sum[k]) / 20000 - 0.5) < 0.01);
  CHECK(std::abs(static_cast<double>(low) / 20000 - 0.25) < 0.015);
}
