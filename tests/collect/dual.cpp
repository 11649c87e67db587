#include "lib/collect/dual.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <set>

#include "tests/collect/cells_by_definition.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Rows = std::vector<std::vector<std::uint32_t>>;

Rows rows_of(const Dual& dual) {
  Rows rows;
  const auto corners = static_cast<std::size_t>(dual.corners);
  for (std::size_t k = 0; k < dual.size(); ++k)
    rows.emplace_back(dual.simplices.begin() + static_cast<std::ptrdiff_t>(k * corners),
                      dual.simplices.begin() + static_cast<std::ptrdiff_t>((k + 1) * corners));
  return rows;
}

/// A square cut along its diagonal into two triangles.
Mesh two_triangles() {
  return {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 3}};
}

long double signed_measure(const SeedsView& seeds, const std::vector<std::uint32_t>& row) {
  const auto at = [&](std::size_t k) {
    const double* p = &seeds.positions[row[k] * static_cast<std::size_t>(seeds.dimension)];
    return Vec{p[0], p[1], seeds.dimension == 3 ? p[2] : 0.0};
  };
  const Vec a = at(1) - at(0), b = at(2) - at(0);
  if (row.size() == 3) return cross(a, b).z;
  return dot(a, cross(b, at(3) - at(0)));
}

/// The dual of random seeds in a domain against the corners that the reference diagram records.
void compare_with_reference(const Domain& domain, const SeedsView& seeds) {
  const Dual dual = make_dual(cells_by_definition(domain, seeds), seeds);
  std::set<std::array<std::uint32_t, 4>> found;
  const Rows rows = rows_of(dual);
  CHECK(std::is_sorted(rows.begin(), rows.end()));
  for (std::vector<std::uint32_t> row : rows) {
    CHECK(row[0] == *std::min_element(row.begin(), row.end()));
    if (domain.kind() != DomainKind::surface) CHECK(signed_measure(seeds, row) > 0);
    std::sort(row.begin(), row.end());
    found.insert({row[0], row[1], row[2], row.back()});
  }
  CHECK(found.size() == rows.size());
  CHECK(found.size() > 0);
  CHECK((found == brute_force(domain.mesh(), seeds).simplices));
}

}  // namespace

TEST_CASE("three cells of a square meet in one triangle, counter-clockwise") {
  const std::vector<double> ccw = {0.2, 0.2, 0.9, 0.3, 0.4, 0.9}, cw = {0.2, 0.2, 0.4, 0.9, 0.9, 0.3};
  for (const std::vector<double>& positions : {ccw, cw}) {
    const SeedsView seeds{2, positions, {}};
    const Dual dual = make_dual(cells_by_definition(unit_box(2), seeds), seeds);
    const Rows expected = {positions == ccw ? std::vector<std::uint32_t>{0, 1, 2}
                                            : std::vector<std::uint32_t>{0, 2, 1}};
    CHECK(dual.corners == 3);
    CHECK((rows_of(dual) == expected));
  }
}

TEST_CASE("a corner on the border between two regions is found by the cell that does not cross it") {
  // The three cells meet at (1/2, 1/2), on the diagonal.
  const SeedArray seeds = {3, {0.3, 0.5, 0, 0.62, 0.34, 0, 0.62, 0.66, 0}, {0, 0, 0}};
  const Dual dual = make_dual(cells_by_definition(surface_of(two_triangles()), seeds.view()), seeds.view());
  CHECK((rows_of(dual) == Rows{{0, 1, 2}}));
}

TEST_CASE("rows on a surface follow its triangles") {
  SeedArray seeds = {3, {0.2, 0.2, 0, 0.9, 0.3, 0, 0.4, 0.9, 0}, {0, 0, 0}};
  Mesh mesh = two_triangles();
  const auto dual_of = [&] {
    return make_dual(cells_by_definition(surface_of(mesh), seeds.view()), seeds.view());
  };
  CHECK((rows_of(dual_of()) == Rows{{0, 1, 2}}));
  for (std::size_t t = 0; t < mesh.elements.size(); t += 3) std::swap(mesh.elements[t], mesh.elements[t + 1]);
  CHECK((rows_of(dual_of()) == Rows{{0, 2, 1}}));
}

TEST_CASE("a triple that meets in two points of a surface gives one row") {
  // Three seeds on the equator of a sphere: their cells meet at both poles.
  const SeedArray seeds = {3, {1, 0, 0.01, -0.5, 0.8, 0, -0.5, -0.9, 0}, {0, 0, 0}};
  const Dual dual = make_dual(cells_by_definition(surface_of(icosphere(1)), seeds.view()), seeds.view());
  CHECK(dual.size() == 1);
}

TEST_CASE("the dual of random seeds has the corners that the definition gives") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
    const SeedArray plane = random_seeds(Distribution::white, range, 60, 2, random);
    compare_with_reference(unit_box(2), plane.view());
    const SeedArray space = random_seeds(Distribution::white, range, 25, 3, random);
    compare_with_reference(unit_box(3), space.view());
    compare_with_reference(volume_of(cube_tetrahedra(2, 0.2, random)), space.view());
    const Domain sphere = surface_of(icosphere(2));
    compare_with_reference(sphere, seeds_for(sphere, Distribution::white, range, 30, random).view());
  }
}

TEST_CASE("no seeds and one seed have an empty dual") {
  const SeedsView none{2, {}, {}};
  CHECK(make_dual(cells_by_definition(unit_box(2), none), none).size() == 0);
  const std::vector<double> position = {0.5, 0.5};
  const SeedsView one{2, position, {}};
  CHECK(make_dual(cells_by_definition(unit_box(2), one), one).size() == 0);
}
