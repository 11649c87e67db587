// LocalDiagram under insertion and removal, compared with powercell::Diagram.
#include "lib/applications/remeshing/local_diagram.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <powercell/powercell.hpp>

#include "tests/applications/remeshing/surface_from.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {
namespace {

using namespace remeshing;

double area_of(const LocalDiagram& cells, std::uint32_t i) {
  double area = 0;
  for (const std::uint32_t p : cells.pieces(i)) {
    const auto& ring = cells.piece(p).ring;
    for (std::size_t v = 1; v + 1 < ring.size(); ++v)
      area += norm(normal_of(ring[0].at, ring[v].at, ring[v + 1].at)) / 2;
  }
  return area;
}

struct Trial {
  Surface surface;
  Domain domain;
  LocalDiagram cells;
  std::vector<double> at;  // positions by seed index, including removed seeds
  std::vector<double> weight;
  Random random{test_seed()};
  double spacing;

  Trial(const TriangleMesh& mesh, std::size_t n)
      : surface(surface_from(mesh)),
        domain(Domain::surface(mesh.vertices, mesh.triangles)),
        cells(surface),
        spacing(std::sqrt(domain.measure() / static_cast<double>(n))) {}

  /// \param range  of the weights, in units of the squared spacing
  void insert(double range) {
    const std::vector<double> x = points_in(domain, 1, random);
    const double w = random.uniform(0, range) * spacing * spacing;
    const Vec off{random.normal(), random.normal(), random.normal()};
    const Vec place = Vec{x[0], x[1], x[2]} + off * (0.1 * spacing);
    const std::uint32_t id = cells.insert(place, w, spacing * random.uniform(0.3, 3));
    if (id >= weight.size()) {
      weight.resize(id + 1);
      at.resize(3 * (id + 1));
    }
    at[3 * id] = place.x;
    at[3 * id + 1] = place.y;
    at[3 * id + 2] = place.z;
    weight[id] = w;
  }
  void remove_any() {
    std::uint32_t id = 0;
    do id = static_cast<std::uint32_t>(random.index(cells.size()));
    while (!cells.seed(id).alive);
    cells.remove(id);
  }
  void compare(Diagram& fresh) {
    std::vector<std::uint32_t> alive;
    std::vector<double> positions, weights;
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      if (!cells.seed(i).alive) {
        CHECK(cells.pieces(i).empty());
        continue;
      }
      alive.push_back(i);
      positions.insert(positions.end(), &at[3 * i], &at[3 * i] + 3);
      weights.push_back(weight[i]);
    }
    fresh.set_seeds({3, positions, weights});
    const Measures& measures = fresh.measures();
    const Adjacency& adjacency = fresh.adjacency();
    const double rounding = 1e-9 * domain.measure();
    for (std::size_t k = 0; k < alive.size(); ++k) {
      CAPTURE(alive[k]);
      CHECK(std::fabs(area_of(cells, alive[k]) - measures.mass[k]) <= rounding);
      std::vector<std::uint32_t> wanted;
      for (std::uint64_t e = adjacency.offset[k]; e < adjacency.offset[k + 1]; ++e)
        if (adjacency.wall[e] > 1e-7 * spacing) wanted.push_back(alive[adjacency.neighbor[e]]);
      const std::vector<std::uint32_t> got = cells.neighbors(alive[k]);
      CHECK(std::includes(got.begin(), got.end(), wanted.begin(), wanted.end()));
    }
  }
};

void insert_and_remove(const TriangleMesh& mesh, std::size_t n, double range) {
  INFO(replay_hint());
  Trial trial(mesh, n);
  Diagram fresh(main_setups().front().device, trial.domain);
  for (std::size_t k = 0; k < n; ++k) trial.insert(range);
  trial.compare(fresh);
  for (std::size_t k = 0; k < n / 2; ++k) trial.remove_any();
  trial.compare(fresh);
  for (std::size_t k = 0; k < n / 3; ++k) {
    trial.insert(range);
    trial.remove_any();
  }
  trial.compare(fresh);
}

}  // namespace

TEST_CASE("cells after insertions and removals agree with a new diagram") {
  SUBCASE("torus, equal weights") {
    insert_and_remove(small_torus(), 300, 0);
  }
  SUBCASE("torus, weights that hide many seeds") {
    insert_and_remove(small_torus(), 300, 4);
  }
  SUBCASE("few seeds") {
    insert_and_remove(small_torus(), 5, 0.5);
  }
  SUBCASE("open sheet") {
    insert_and_remove(wavy_sheet(), 400, 0.5);
  }
  SUBCASE("large triangles") {
    insert_and_remove(cube_of_12(), 300, 0.5);
  }
  SUBCASE("two sides close together") {
    insert_and_remove(plate(0.02), 200, 0.5);
  }
}

TEST_CASE("a diagram can lose all its seeds and get new ones") {
  const Surface surface = surface_from(cube_of_12());
  LocalDiagram cells(surface);
  const std::uint32_t a = cells.insert({0.1, 0.2, 0.9}, 0, 1), b = cells.insert({0.8, 0.3, 0.1}, 0, 1);
  CHECK(area_of(cells, a) + area_of(cells, b) == doctest::Approx(6));
  cells.remove(a);
  CHECK(area_of(cells, b) == doctest::Approx(6));
  cells.remove(b);
  CHECK(cells.alive() == 0);
  const std::uint32_t c = cells.insert({0.5, 0.5, 0}, -3, 1);
  CHECK(area_of(cells, c) == doctest::Approx(6));
}

}  // namespace powercell::test
