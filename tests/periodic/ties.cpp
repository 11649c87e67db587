// Lattices of seeds: every vertex of every cell is a tie, decided alike by all images.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/periodic/brute_force.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

SeedArray grid_of(int dimension, int per_axis, const std::array<double, 3>& low, double edge) {
  SeedArray seeds = grid(per_axis, dimension, {{0, 0, 0}, {1, 1, 1}});
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (int k = 0; k < dimension; ++k)
      seeds.coordinate(i, k) = low[static_cast<std::size_t>(k)] + edge * seeds.coordinate(i, k);
  return seeds;
}

/// Masses are equal, walls are those of cubes, and both sides of walls match to the bit before they are
/// averaged.
void check_grid(Diagram& diagram, std::size_t n, int dimension, double edge, int per_axis) {
  diagram.compute(true, true);
  const double side = edge / per_axis, mass = std::pow(side, dimension), wall = std::pow(side, dimension - 1);
  const Adjacency& adjacency = diagram.adjacency();
  CHECK(adjacency.asymmetry <= 1e-15 * wall);
  for (std::size_t i = 0; i < n; ++i) {
    CHECK(diagram.measures().mass[i] == doctest::Approx(mass).epsilon(1e-13));
    double sum = 0;
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k) sum += adjacency.wall[k];
    CHECK(sum == doctest::Approx(2 * dimension * wall).epsilon(1e-12));
  }
}

/// The faces of cells, those without extent too, have their other sides: the cells form one triangulation.
void check_faces_match(const Cells& cells) {
  std::map<std::tuple<std::uint32_t, std::uint32_t, ImageShift>, int> count;
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
      for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f)
        if (cells.border[f].kind == Border::Kind::wall) ++count[{i, cells.border[f].index, cells.shift[f]}];
  CHECK(count.size() > cells.cell_count());
  for (const auto& [face, times] : count) {
    const auto& [i, j, s] = face;
    CHECK(times == 1);
    CHECK(count.count({j, i, {-s[0], -s[1], -s[2]}}) == 1);
  }
}

}  // namespace

TEST_CASE("grids in periodic boxes") {
  for (const Setup& setup : main_setups()) {
    if (setup.options.precision == Precision::float32) continue;
    for (const int d : {2, 3})
      for (const int per_axis : {1, 2, 3, 4, 6}) {
        INFO(setup.name << ", " << d << "D, " << per_axis);
        // Positions of a third are rounded; those of a quarter tie exactly.
        const double edge = per_axis % 3 == 0 ? 3 : 2;
        std::array<double, 3> low{-1, 0.5, 4}, high{};
        for (std::size_t k = 0; k < 3; ++k) high[k] = low[k] + edge;
        const auto corners = [&](const std::array<double, 3>& x) {
          return std::span(x).first(static_cast<std::size_t>(d));
        };
        const SeedArray seeds = grid_of(d, per_axis, low, edge);
        Diagram diagram(setup.device, Domain::periodic_box(corners(low), corners(high)), setup.options);
        diagram.set_seeds(seeds.view());
        check_grid(diagram, seeds.size(), d, edge, per_axis);
        check_faces_match(diagram.cells());
      }
  }
}

TEST_CASE("seeds that tie through their images only") {
  // One seed of a cubic, body-centred and face-centred lattice, and two of a hexagonal close packing nearly.
  const std::array<std::array<double, 3>, 3> lattices[] = {{{{1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0.5}}},
                                                           {{{0, 1, 1}, {1, 0, 1}, {1, 1, 0}}},
                                                           {{{1, 0, 0}, {0, 1, 0}, {0, 1, 1}}}};
  const Setup& setup = main_setups().front();
  for (const auto& vectors : lattices) {
    const PeriodicSpace space = lattice_space(vectors, 3, 3);
    SeedArray seeds;
    seeds.push({0.25, 0.125, 7}, 0);
    for (int n = 1; n <= 2; ++n) {
      Diagram diagram(setup.device, space.domain(), setup.options);
      diagram.set_seeds(seeds.view());
      check_periodic(diagram, space, seeds, periodic_cells(space, seeds), 1e-12);
      check_faces_match(diagram.cells());
      seeds.push({0.75, 0.125, 7.5}, 0);
    }
  }
}

TEST_CASE("a seed wrapped across the border is the same seed") {
  const Setup& setup = main_setups().front();
  const std::array<double, 3> low{0, 0, 0}, high{1, 1, 1};
  Diagram diagram(setup.device, Domain::periodic_box(low, high), setup.options);
  // The second and third are images of the first, on different sides of the box; the last is one of the
  // fourth.
  SeedArray seeds;
  seeds.push({0, 0.5, 0.25}, 0);
  seeds.push({1, 0.5, 0.25}, 1e-3);
  seeds.push({-3, 0.5, 5.25}, 0);
  seeds.push({0.5, 0.25, 1}, 0);
  seeds.push({0.5, 0.25, 0}, 0);
  diagram.set_seeds(seeds.view());
  const Measures& measures = diagram.measures();
  CHECK(measures.status[0] == SeedStatus::duplicate);
  CHECK(measures.status[1] == SeedStatus::ok);
  CHECK(measures.status[2] == SeedStatus::duplicate);
  CHECK(measures.status[3] == SeedStatus::ok);
  CHECK(measures.status[4] == SeedStatus::duplicate);
  CHECK(measures.total() == doctest::Approx(1).epsilon(1e-14));
}
