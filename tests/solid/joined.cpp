// The geometry of cells in solids: closed surfaces, with the measures and walls that they have otherwise.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

#include "lib/base/vectors.hpp"
#include "tests/solid/both_ways.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Point = Vector3<double>;

struct Cell {
  const JoinedCells& all;
  std::size_t i;

  Point at(std::uint32_t v) const {
    const double* const x = &all.vertices[3 * (all.vertex_offset[i] + v)];
    return {x[0], x[1], x[2]};
  }
  std::span<const std::uint32_t> loop(std::uint64_t f) const {
    return std::span(all.loop).subspan(all.loop_offset[f], all.loop_offset[f + 1] - all.loop_offset[f]);
  }
  Point twice_area(std::uint64_t f) const {
    const auto face = loop(f);
    Point sum{};
    for (std::size_t k = 2; k < face.size(); ++k)
      sum = sum + cross(at(face[k - 1]) - at(face[0]), at(face[k]) - at(face[0]));
    return sum;
  }
};

/// The number of times that edges occur in one direction less that in the other; 0 for a closed surface.
/// \param repeats  counts edges that occur more than once in a direction
int open_edges(const Cell& cell, int& repeats) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (std::uint64_t f = cell.all.face_offset[cell.i]; f < cell.all.face_offset[cell.i + 1]; ++f) {
    const auto loop = cell.loop(f);
    for (std::size_t k = 0; k < loop.size(); ++k) ++count[{loop[k], loop[(k + 1) % loop.size()]}];
  }
  int open = 0;
  for (const auto& [edge, times] : count) {
    const auto back = count.find({edge.second, edge.first});
    open += std::abs(times - (back == count.end() ? 0 : back->second));
    repeats += times > 1;
  }
  return open;
}

/// Whether all turns of a face are to the left, within rounding.
bool is_convex(const Cell& cell, std::uint64_t f) {
  const auto loop = cell.loop(f);
  const Point normal = cell.twice_area(f);
  double extent = 0;
  for (const std::uint32_t v : loop) extent = std::max(extent, norm(cell.at(v) - cell.at(loop[0])));
  for (std::size_t k = 0, n = loop.size(); k < n; ++k) {
    const Point a = cell.at(loop[k]), b = cell.at(loop[(k + 1) % n]), c = cell.at(loop[(k + 2) % n]);
    if (dot(normal, cross(b - a, c - b)) < -1e-10 * norm(normal) * extent * (extent + norm(a))) return false;
  }
  return true;
}

struct Checked {
  std::string faults;
  int repeats = 0;        // edges that occur more than once
  double boundary = 0;    // area of all faces on the boundary
  std::size_t walls = 0;  // faces that are walls
};

/// Compares the geometry with measures and walls, to 1e-12 of the mean.
/// \param tied  whether seeds tie with the boundary, so that faces may have spikes without width
Checked check(Diagram& diagram, bool tied) {
  const JoinedCells& all = diagram.joined();
  const Measures& measures = diagram.measures();
  const Adjacency& adjacency = diagram.adjacency();
  const std::vector<double> positions = diagram.positions();
  const std::size_t n = diagram.size();
  const double mean = measures.domain_measure / static_cast<double>(n), h = std::cbrt(mean);
  Checked checked;
  std::ostringstream faults;
  REQUIRE(all.vertex_offset.size() == n + 1);
  REQUIRE(all.face_offset.size() == n + 1);
  REQUIRE(all.face_border.size() + 1 == all.loop_offset.size());
  for (std::size_t i = 0; i < n; ++i) {
    const Cell cell{all, i};
    const bool ok = measures.status[i] == SeedStatus::ok;
    if (ok != (all.face_offset[i] < all.face_offset[i + 1])) faults << "faces of " << i << "\n";
    if (!ok) continue;
    if (const int open = open_edges(cell, checked.repeats)) faults << open << " open edges of " << i << "\n";
    double volume = 0, reach = h;
    std::map<std::uint32_t, double> walls;
    const Point origin = cell.at(0);
    for (std::uint64_t f = all.face_offset[i]; f < all.face_offset[i + 1]; ++f) {
      const Point area = cell.twice_area(f);
      for (const std::uint32_t v : cell.loop(f)) reach = std::max(reach, norm(cell.at(v) - origin));
      volume += dot(cell.at(cell.loop(f)[0]) - origin, area) / 6;
      if (all.face_border[f].kind == Border::Kind::boundary) checked.boundary += norm(area) / 2;
      if (all.face_border[f].kind == Border::Kind::wall) {
        const std::uint32_t j = all.face_border[f].index;
        const Point d = difference<double>(&positions[3 * std::size_t{j}], &positions[3 * i]);
        walls[j] += dot(area, d) / norm(d) / 2;
        ++checked.walls;
      }
      if (!tied && !is_convex(cell, f))
        faults << "face " << f - all.face_offset[i] << " of " << i << " not convex\n";
    }
    if (!(std::abs(volume - measures.mass[i]) <= 1e-12 * std::max(mean, reach * reach * h)))
      faults << "volume of " << i << ": " << volume << ", not " << measures.mass[i] << "\n";
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k)
      walls[adjacency.neighbor[k]] -= adjacency.wall[k];
    for (const auto& [j, difference] : walls)
      if (!(std::abs(difference) <= 1e-12 * std::max(h * h, reach * reach)))
        faults << "wall " << i << " " << j << " differs by " << difference << "\n";
  }
  checked.faults = faults.str();
  return checked;
}

Diagram diagram_of(const Domain& domain, const SeedArray& seeds) {
  Diagram diagram(double_device_of_tests(), domain);
  diagram.set_seeds(seeds.view());
  return diagram;
}

double area_of(const Mesh& surface) {
  double area = 0;
  for (std::size_t t = 0; t < surface.elements.size(); t += 3) {
    const auto at = [&](std::size_t k) {
      return &surface.vertices[3 * std::size_t{surface.elements[t + k]}];
    };
    area += norm(cross(difference<double>(at(1), at(0)), difference<double>(at(2), at(0)))) / 2;
  }
  return area;
}

}  // namespace

TEST_CASE("solid: joined cells are closed and have the measures and walls of the diagram") {
  if (!has_double()) return;
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedMesh& named : solid_meshes(random)) {
    const Domain domain = volume_of(named.mesh);
    const Mesh surface = boundary_mesh(domain);
    const Domain solid = Domain::solid(surface.vertices, surface.elements);
    for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
      for (const std::size_t n : {1, 2, 3, 8, 60, 1000}) {
        if (n == 1000 && range != WeightRange::W1 && !all_inputs()) continue;
        CAPTURE(named.name);
        CAPTURE(n);
        CAPTURE(name(range));
        const SeedArray seeds = seeds_for(domain, Distribution::white, range, n, random);
        Diagram diagram = diagram_of(solid, seeds), twin = diagram_of(domain, seeds);
        const Checked checked = check(diagram, false);
        CHECK(checked.faults == "");
        if (named.name != "sponge") CHECK(checked.repeats == 0);  // its surface touches itself in edges
        CHECK(checked.boundary == doctest::Approx(area_of(surface)).epsilon(1e-12));
        CHECK(diagram.dual().simplices == twin.dual().simplices);
      }
  }
}

TEST_CASE("solid: joined cells whose seeds tie with the boundary") {
  if (!has_double()) return;
  Random random(1);
  for (const NamedMesh& named : solid_meshes(random)) {
    const Domain domain = volume_of(named.mesh);
    const Mesh surface = boundary_mesh(domain);
    const Domain solid = Domain::solid(surface.vertices, surface.elements);
    for (const double shift : {0.0, 0.125, 0.25}) {
      const SeedArray seeds = quarters(shift);
      CAPTURE(named.name);
      CAPTURE(shift);
      Diagram diagram = diagram_of(solid, seeds);
      const Checked checked = check(diagram, true);
      CHECK(checked.faults == "");
      CHECK(checked.boundary == doctest::Approx(area_of(surface)).epsilon(1e-12));
      Diagram twin = diagram_of(domain, seeds);
      CHECK(diagram.dual().simplices == twin.dual().simplices);
    }
  }
}

TEST_CASE("solid: a wall of which a part lies in the boundary") {
  if (!has_double()) return;
  Random random(1);
  // Without the corner x, y, z > 1/2, a smaller one, or one at the other end, so that the wall x = 1/2 has a
  // step beside it.
  for (const double step : {0.5, 0.75, -0.5, -0.75}) {
    const Domain domain =
        volume_of(part_of(cube_tetrahedra(4, 0, random), [&](const std::array<double, 3>& x) {
          return (step > 0 ? x[0] < 0.5 : x[0] > 0.5) || std::min(x[1], x[2]) < std::abs(step);
        }));
    const Mesh surface = boundary_mesh(domain);
    const Domain solid = Domain::solid(surface.vertices, surface.elements);
    for (int order = 0; order < 4; ++order) {
      SeedArray seeds;
      for (int k = 0; k < 2; ++k) seeds.push({(k == order % 2) ? 0.25 : 0.75, 0.5, 0.5}, 0);
      if (order > 1) seeds.push({0.25, 0.5, 1.5}, 0);
      CAPTURE(step);
      CAPTURE(order);
      Diagram diagram = diagram_of(solid, seeds);
      const Checked checked = check(diagram, true);
      CHECK(checked.faults == "");
      CHECK(checked.boundary == doctest::Approx(area_of(surface)).epsilon(1e-12));
    }
  }
}

TEST_CASE("solid: joined cells of random sets of cubes, with walls in their faces") {
  if (!has_double()) return;
  INFO(replay_hint());
  Random random(test_seed());
  for (int trial = 0; trial < number_of_inputs(10, 30); ++trial) {
    const double share = random.uniform(0.3, 0.95);
    const int parts = trial % 2 ? 2 : 4, per_row = trial % 3 ? 2 : 4;
    // Whole cubes, so that walls meet the boundary in faces; or tetrahedra, which walls cut too.
    std::map<std::array<int, 3>, bool> kept;
    const bool cubes = trial % 5 > 0;
    const Mesh mesh = part_of(cube_tetrahedra(parts, 0, random), [&](const std::array<double, 3>& x) {
      std::array<int, 3> cube;
      for (std::size_t k = 0; k < 3; ++k) cube[k] = static_cast<int>(parts * x[k]);
      const bool keep = random.uniform() < share;
      return cubes ? kept.try_emplace(cube, keep).first->second : keep;
    });
    if (mesh.elements.size() < 8) continue;
    const Domain domain = volume_of(mesh);
    const Mesh surface = boundary_mesh(domain);
    const Domain solid = Domain::solid(surface.vertices, surface.elements);
    SeedArray seeds = grid(per_row, 3);
    if (trial % 4 == 3)  // fewer, and heavier ones among them
      for (double& w : seeds.weights) w = random.uniform() < 0.3 ? 0.125 : 0;
    CAPTURE(trial);
    Diagram diagram = diagram_of(solid, seeds);
    const Checked checked = check(diagram, true);
    CHECK(checked.faults == "");
    CHECK(checked.boundary == doctest::Approx(area_of(surface)).epsilon(1e-12));
  }
}

TEST_CASE("solid: joined cells whose walls lie in the boundary but for rounding") {
  if (!has_double()) return;
  INFO(replay_hint());
  Random random(test_seed());
  for (int trial = 0; trial < number_of_inputs(6, 20); ++trial) {
    // The cubes and grid of above, turned.
    const double share = random.uniform(0.4, 0.95), a = random.uniform(0, 6), b = random.uniform(0, 6);
    std::map<std::array<int, 3>, bool> kept;
    Mesh mesh = part_of(cube_tetrahedra(4, 0, random), [&](const std::array<double, 3>& x) {
      const std::array<int, 3> cube{static_cast<int>(4 * x[0]), static_cast<int>(4 * x[1]),
                                    static_cast<int>(4 * x[2])};
      return kept.try_emplace(cube, random.uniform() < share).first->second;
    });
    if (mesh.elements.size() < 8) continue;
    SeedArray seeds = grid(trial % 3 ? 2 : 4, 3);
    for (std::vector<double>* const points : {&mesh.vertices, &seeds.positions})
      for (std::size_t k = 0; k < points->size(); k += 3) {
        double* const x = &(*points)[k];
        std::tie(x[0], x[1]) =
            std::pair(std::cos(a) * x[0] - std::sin(a) * x[1], std::sin(a) * x[0] + std::cos(a) * x[1]);
        std::tie(x[1], x[2]) =
            std::pair(std::cos(b) * x[1] - std::sin(b) * x[2], std::sin(b) * x[1] + std::cos(b) * x[2]);
      }
    const Domain domain = volume_of(mesh);
    const Mesh surface = boundary_mesh(domain);
    CAPTURE(trial);
    Diagram diagram = diagram_of(Domain::solid(surface.vertices, surface.elements), seeds);
    CHECK(check(diagram, true).faults == "");
  }
}

TEST_CASE("solid: facets of cells, and the geometry of some cells") {
  if (!has_double()) return;
  Random random(test_seed());
  const Domain domain = volume_of(solid_meshes(random)[3].mesh);
  const Mesh surface = boundary_mesh(domain);
  const Domain solid = Domain::solid(surface.vertices, surface.elements);
  const SeedArray seeds = seeds_for(domain, Distribution::white, WeightRange::W2, 200, random);
  Diagram all = diagram_of(solid, seeds), some = diagram_of(solid, seeds), twin = diagram_of(domain, seeds);
  const BoundaryWalls walls = all.boundary_walls();
  double area = 0;
  for (const double part : walls.measure) area += part;
  CHECK(area == doctest::Approx(area_of(surface)).epsilon(1e-12));
  for (std::size_t i = 0; i < seeds.size(); ++i) {  // the numbers of facets differ, the cell's area does not
    double here = 0, there = 0;
    for (std::uint64_t k = walls.offset[i]; k < walls.offset[i + 1]; ++k) here += walls.measure[k];
    const BoundaryWalls& other = twin.boundary_walls();
    for (std::uint64_t k = other.offset[i]; k < other.offset[i + 1]; ++k) there += other.measure[k];
    CHECK(here == doctest::Approx(there).epsilon(1e-11));
  }
  const std::vector<std::uint32_t> selected{70, 3, 199};
  some.select(selected);
  for (std::size_t row = 0; row < selected.size(); ++row) {
    const std::uint32_t i = selected[row];
    const JoinedCells &from = all.joined(), &to = some.joined();
    REQUIRE(to.face_offset.size() == 4);
    const Cell a{from, i}, b{to, row};
    REQUIRE(from.face_offset[i + 1] - from.face_offset[i] == to.face_offset[row + 1] - to.face_offset[row]);
    for (std::uint64_t f = from.face_offset[i], g = to.face_offset[row]; f < from.face_offset[i + 1];
         ++f, ++g) {
      CHECK(from.face_border[f] == to.face_border[g]);
      CHECK(std::ranges::equal(a.loop(f), b.loop(g)));
      CHECK(a.twice_area(f) == b.twice_area(g));
    }
    CHECK(some.boundary_walls().offset[row + 1] - some.boundary_walls().offset[row] ==
          walls.offset[i + 1] - walls.offset[i]);
  }
}
