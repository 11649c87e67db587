#include "tests/solid/both_ways.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "lib/diagram/state.hpp"
#include "lib/domain/outline.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {
namespace {

constexpr double tolerance = 1e-12;
constexpr double least =
    1e-13;  // walls that may be missing: of solids without tetrahedra those within rounding

std::optional<Device> double_device() {
  for (const Setup& setup : main_setups())
    if (setup.device.info().fp64) return setup.device;
  return {};
}

void compare_rows(const Adjacency& a, const Adjacency& b, double mean, std::ostringstream& out) {
  for (std::size_t i = 0; i + 1 < a.offset.size(); ++i) {
    std::map<std::uint32_t, double> other;
    for (std::uint64_t k = b.offset[i]; k < b.offset[i + 1]; ++k) other[b.neighbor[k]] = b.wall[k];
    for (std::uint64_t k = a.offset[i]; k < a.offset[i + 1]; ++k) {
      const auto found = other.find(a.neighbor[k]);
      if (found == other.end()) {
        if (a.wall[k] > least * mean)
          out << "wall " << i << " " << a.neighbor[k] << " by the boundary alone, area " << a.wall[k] << "\n";
        continue;
      }
      if (!(std::abs(found->second - a.wall[k]) <= tolerance * mean))
        out << "wall " << i << " " << a.neighbor[k] << ": " << a.wall[k] << ", not " << found->second << "\n";
      other.erase(found);
    }
    for (const auto& [j, area] : other)
      if (area > least * mean) out << "wall " << i << " " << j << " missing, area " << area << "\n";
  }
}

}  // namespace

std::vector<NamedMesh> solid_meshes(Random& random) {
  const Mesh cube = cube_tetrahedra(4, 0.2, random), plain = cube_tetrahedra(4, 0, random),
             fine = cube_tetrahedra(8, 0.1, random);
  return {
      {"cube", cube},
      {"ball", ball_tetrahedra(2)},
      {"cube without a corner",
       part_of(plain,
               [](const std::array<double, 3>& x) {
                 return std::max({x[0], x[1], x[2]}) < 0.5 || std::min({x[0], x[1], x[2]}) < 0.5;
               })},
      {"cube with a cavity",
       part_of(fine,
               [](const std::array<double, 3>& x) {
                 return std::max({std::abs(x[0] - .5), std::abs(x[1] - .5), std::abs(x[2] - .5)}) > .2;
               })},
      {"slabs", part_of(plain, [](const std::array<double, 3>& x) { return x[0] < 0.25 || x[0] > 0.5; })},
      {"sponge", part_of(fine,
                         [](const std::array<double, 3>& x) {
                           const double turns = 4 * std::acos(-1);
                           return std::sin(turns * x[0]) * std::cos(turns * x[1]) +
                                      std::sin(turns * x[1]) * std::cos(turns * x[2]) +
                                      std::sin(turns * x[2]) * std::cos(turns * x[0]) <
                                  0.3;
                         })},
  };
}

Device double_device_of_tests() {
  return double_device().value();
}

bool has_double() {
  return double_device().has_value();
}

SeedArray quarters(double shift) {
  SeedArray seeds;
  for (int k = 0; k < 7 * 7 * 7; ++k)
    seeds.push({(k % 7) * 0.25 - shift, (k / 7 % 7) * 0.25 - shift, (k / 49) * 0.25 - shift}, 0);
  return seeds;
}

BothWays compute_both_ways(const Domain& domain, const SeedArray& seeds) {
  return compute_without_tetrahedra(domain, domain, seeds);
}

BothWays compute_without_tetrahedra(const Domain& solid, const Domain& domain, const SeedArray& seeds) {
  BothWays both;
  Diagram::State first(double_device().value(), solid, {});
  first.set_seeds(seeds.view());
  first.compute({.adjacency = true});
  both.unclear = first.integrals->solid->unclear.size() + first.active->by_region.size();
  both.by_boundary = *first.results->measures;
  both.walls_by_boundary = *first.results->adjacency;
  Diagram::State second(double_device().value(), domain, {});
  second.setup.boundary.reset();
  second.set_seeds(seeds.view());
  second.compute({.adjacency = true});
  both.by_tetrahedra = *second.results->measures;
  both.walls_by_tetrahedra = *second.results->adjacency;
  return both;
}

Mesh boundary_mesh(const Domain& domain) {
  const RegionMesh surface = boundary_surface(domain.mesh());
  return {surface.vertices, surface.region_vertex};
}

std::string differences(const BothWays& both, const SeedArray& seeds) {
  const Measures &a = both.by_boundary, &b = both.by_tetrahedra;
  std::ostringstream out;
  out.precision(17);
  const double mean = b.domain_measure / static_cast<double>(seeds.size()), h = std::cbrt(mean);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (a.status[i] != b.status[i]) out << "status of " << i << "\n";
    if (!(std::abs(a.mass[i] - b.mass[i]) <= tolerance * mean))
      out << "mass of " << i << ": " << a.mass[i] << ", not " << b.mass[i] << "\n";
    // Integrals about the seed grow with its distance from the cell.
    const double reach = std::max(h, std::sqrt(b.second_moment[i] / std::max(b.mass[i], mean)));
    if (!(std::abs(a.second_moment[i] - b.second_moment[i]) <= 4 * tolerance * mean * reach * reach))
      out << "second moment of " << i << ": " << a.second_moment[i] << ", not " << b.second_moment[i] << "\n";
    for (std::size_t k = 3 * i; b.mass[i] > 0 && k < 3 * i + 3; ++k)
      if (!(std::abs(a.centroid[k] - b.centroid[k]) * b.mass[i] <= 4 * tolerance * mean * reach))
        out << "centroid of " << i << ": " << a.centroid[k] << ", not " << b.centroid[k] << "\n";
  }
  double wall = 0;
  for (const double area : both.walls_by_tetrahedra.wall) wall += area;
  if (wall > 0) wall /= static_cast<double>(both.walls_by_tetrahedra.wall.size());
  compare_rows(both.walls_by_boundary, both.walls_by_tetrahedra, wall, out);
  return out.str();
}

}  // namespace powercell::test
