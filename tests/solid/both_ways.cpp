#include "tests/solid/both_ways.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "lib/diagram/state.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {
namespace {

constexpr double tolerance = 1e-12;

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
        out << "wall " << i << " " << a.neighbor[k] << " by the boundary alone, area " << a.wall[k] << "\n";
        continue;
      }
      if (!(std::abs(found->second - a.wall[k]) <= tolerance * mean))
        out << "wall " << i << " " << a.neighbor[k] << ": " << a.wall[k] << ", not " << found->second << "\n";
      other.erase(found);
    }
    for (const auto& [j, area] : other) out << "wall " << i << " " << j << " missing, area " << area << "\n";
  }
}

}  // namespace

bool has_double() {
  return double_device().has_value();
}

BothWays compute_both_ways(const Domain& domain, const SeedArray& seeds) {
  BothWays both;
  for (const bool by_boundary : {true, false}) {
    Diagram::State diagram(double_device().value(), domain, {});
    if (!by_boundary) diagram.setup.boundary.reset();
    diagram.set_seeds(seeds.view());
    diagram.compute({.adjacency = true});
    if (by_boundary)
      both.unclear = diagram.integrals->solid->unclear.size() + diagram.active->by_region.size();
    (by_boundary ? both.by_boundary : both.by_tetrahedra) = *diagram.results.measures;
    (by_boundary ? both.walls_by_boundary : both.walls_by_tetrahedra) = *diagram.results.adjacency;
  }
  return both;
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
