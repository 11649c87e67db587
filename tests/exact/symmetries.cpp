// Rotated, mirrored, reordered or without hidden seeds, the diagram is the same, also where bisectors run
// through corners and along facets of the domain.
#include <doctest/doctest.h>

#include <array>

#include "tests/exact/tied_seeds.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/permuted.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The images of seeds under a symmetry of the cube about 0: permuted axes, some of them mirrored.
SeedArray rotated(const SeedArray& seeds, Random& random) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  const Permutation axis = random_permutation(d, random);
  std::array<double, 3> sign;
  for (double& s : sign) s = random.index(2) == 0 ? 1 : -1;
  SeedArray result = seeds;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (std::size_t k = 0; k < d; ++k)
      result.positions[i * d + k] = sign[k] * seeds.positions[i * d + axis[k]];
  return result;
}

/// The outcome for n seeds, of which seed from[k] is seed k of `image`; the others have no cells. It has no
/// simplices: where more cells meet in a point, they depend on the order of positions.
Outcome brought_back(const Outcome& image, const Permutation& from, std::size_t n) {
  Outcome result;
  result.measures.status.assign(n, SeedStatus::hidden);
  result.measures.mass.assign(n, 0);
  for (std::size_t k = 0; k < from.size(); ++k) {
    result.measures.status[from[k]] = image.measures.status[k];
    result.measures.mass[from[k]] = image.measures.mass[k];
  }
  for (const auto& [seeds, wall] : image.walls) result.walls[{from[seeds.first], from[seeds.second]}] = wall;
  return result;
}

/// An octahedron with six corners at distance 3/4 from 0: a surface, or tetrahedra about 0.
Domain octahedron(bool surface) {
  std::vector<double> vertices;
  for (std::size_t k = 0; k < 6; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      vertices.push_back(axis == k / 2 ? (k % 2 ? -0.75 : 0.75) : 0);
  vertices.insert(vertices.end(), {0, 0, 0});
  std::vector<std::uint32_t> elements;
  for (std::uint32_t k = 0; k < 8; ++k) {
    std::array<std::uint32_t, 3> corner{k & 1, 2 + (k >> 1 & 1), 4 + (k >> 2 & 1)};
    if ((k ^ k >> 1 ^ k >> 2) & 1) std::swap(corner[0], corner[1]);
    elements.insert(elements.end(), corner.begin(), corner.end());
    if (!surface) elements.push_back(6);
  }
  return surface ? Domain::surface(vertices, elements) : Domain::volume(vertices, elements);
}

Domain centred_box(int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  return Domain::box(std::vector<double>(d, -0.5), std::vector<double>(d, 0.5));
}

Domain centred_block(Random& random) {
  Mesh mesh = cube_tetrahedra(2, 0, random);
  for (double& x : mesh.vertices) x -= 0.5;
  return volume_of(mesh);
}

std::vector<NamedDomain> symmetric_domains(Random& random) {
  return {{"square", centred_box(2)},
          {"cube", centred_box(3)},
          {"cube in tetrahedra", centred_block(random)},
          {"octahedron in tetrahedra", octahedron(false)},
          {"octahedron", octahedron(true)}};
}

/// Whether the bisector contains a triangle of the octahedron, which then belongs to the first seed in order.
bool share_a_triangle(const SeedArray& seeds, std::size_t i, std::size_t j) {
  std::array<long double, 3> q;
  long double offset = static_cast<long double>(seeds.weights[i]) - seeds.weights[j];
  for (std::size_t k = 0; k < 3; ++k) {
    const long double a = seeds.positions[3 * i + k], b = seeds.positions[3 * j + k];
    q[k] = std::fabs(b - a);
    offset += (b - a) * (b + a);
  }
  return q[0] == q[1] && q[1] == q[2] && std::fabs(offset) == 1.5L * q[0];
}

SeedArray without_shared_triangles(const SeedArray& seeds) {
  SeedArray kept{3, {}, {}};
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    kept.push({seeds.positions[3 * i], seeds.positions[3 * i + 1], seeds.positions[3 * i + 2]},
              seeds.weights[i]);
    bool shares = false;
    for (std::size_t j = 0; j + 1 < kept.size(); ++j)
      shares = shares || share_a_triangle(kept, j, kept.size() - 1);
    if (!shares) continue;
    kept.positions.resize(kept.positions.size() - 3);
    kept.weights.pop_back();
  }
  return kept;
}

/// Compares no walls on a surface: whether a cell has a piece of no thickness between two others there
/// depends on the order of positions (docs/mathematics.md, "Walls in facets").
void expect_same_on(const Domain& domain, const Outcome& one, const Outcome& other, double tolerance) {
  domain.kind() == DomainKind::surface ? expect_same_cells(one, other, tolerance)
                                       : expect_same(one, other, tolerance);
}

template <class Check>
void for_tied_seeds(int trials, const Check& check) {
  INFO(replay_hint());
  Random random(test_seed());
  const std::vector<NamedDomain> domains = symmetric_domains(random);
  for (const Setup& setup : all_setups())
    for (const NamedDomain& named : domains)
      for (int trial = 0; trial < trials; ++trial) {
        INFO(setup.name << ", " << named.name << ", trial " << trial);
        SeedArray seeds =
            tied_seeds(2 + random.index(20), 0, named.domain.dimension(), trial % 2 == 1, random);
        if (named.domain.kind() == DomainKind::surface) seeds = without_shared_triangles(seeds);
        check(setup, named.domain, seeds, random);
      }
}

}  // namespace

TEST_CASE("rotated, mirrored and reordered, the diagram is the same") {
  for_tied_seeds(10, [](const Setup& setup, const Domain& domain, const SeedArray& seeds, Random& random) {
    const Permutation order = random_permutation(seeds.size(), random);
    const SeedArray image = permuted(rotated(seeds, random), order);
    expect_same_on(domain, outcome_of(setup, domain, seeds.view()),
                   brought_back(outcome_of(setup, domain, image.view()), order, seeds.size()),
                   1e3 * unit_roundoff(setup.options.precision));
  });
}

TEST_CASE("without its hidden seeds the diagram is the same") {
  for_tied_seeds(10, [](const Setup& setup, const Domain& domain, const SeedArray& seeds, Random& random) {
    const Outcome all = outcome_of(setup, domain, seeds.view());
    Permutation with_cells = random_permutation(seeds.size(), random);
    std::erase_if(with_cells, [&](std::uint32_t i) { return all.measures.status[i] != SeedStatus::ok; });
    const Outcome rest = outcome_of(setup, domain, permuted(seeds, with_cells).view());
    expect_same_on(domain, all, brought_back(rest, with_cells, seeds.size()),
                   1e3 * unit_roundoff(setup.options.precision));
  });
}
