#include "tests/support/domains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "lib/domain/region_mesh.hpp"

namespace powercell::test {

namespace {

Ring rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

Ring regular(double x, double y, double radius, int corners) {
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    ring.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  return ring;
}

}  // namespace

Parts unit_square() {
  return {{rectangle(0, 0, 1, 1), {}}};
}

Parts letter_u() {
  return {{{{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0.7, 1}, {0.7, 0.6}, {0.7, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}},
           {}}};
}

Parts square_with_holes() {
  return {{reversed(rectangle(0, 0, 1, 1)), {regular(0.3, 0.35, 0.15, 7), rectangle(0.6, 0.5, 0.9, 0.8)}}};
}

Parts islands() {
  return {{regular(0.4, 0.5, 0.4, 12), {regular(0.4, 0.5, 0.25, 9)}},
          {regular(0.4, 0.5, 0.12, 5), {}},
          {rectangle(0.85, 0.1, 1, 0.9), {}}};
}

Parts comb(int teeth) {
  Ring ring{{0, 0}, {1, 0}};
  const double step = 1.0 / (2 * teeth - 1);
  for (int k = teeth - 1; k >= 0; --k) {
    const double left = 2 * k * step;
    ring.push_back({k == teeth - 1 ? 1.0 : left + step, 1});
    ring.push_back({left, 1});
    if (k == 0) break;
    ring.push_back({left, 0.1});
    ring.push_back({left - step, 0.1});
  }
  return {{ring, {}}};
}

Domain surface_of(const Mesh& mesh) {
  return Domain::surface(mesh.vertices, mesh.elements);
}
Domain volume_of(const Mesh& mesh) {
  return Domain::volume(mesh.vertices, mesh.elements);
}

Domain unit_box(int dimension) {
  const std::vector<double> low(static_cast<std::size_t>(dimension), 0.0);
  const std::vector<double> high(static_cast<std::size_t>(dimension), 1.0);
  return Domain::box(low, high);
}

std::vector<NamedDomain> polygon_domains() {
  return {{"letter_u", Domain::polygon(letter_u())},
          {"square_with_holes", Domain::polygon(square_with_holes())},
          {"islands", Domain::polygon(islands())},
          {"comb", Domain::polygon(comb(5))}};
}

std::vector<NamedDomain> surface_domains() {
  return {{"sphere", surface_of(icosphere(1))},
          {"torus", surface_of(torus(12, 7))},
          {"wavy_patch", surface_of(wavy_patch(6))},
          {"book", surface_of(book(3))}};
}

std::vector<NamedDomain> volume_domains() {
  Random random(7);  // the shape does not depend on the test seed
  return {{"cube_tetrahedra", volume_of(cube_tetrahedra(2, 0.15, random))},
          {"ball_tetrahedra", volume_of(ball_tetrahedra(1))}};
}

std::vector<NamedDomain> box_domains() {
  return {{"box2", unit_box(2)}, {"box3", unit_box(3)}};
}

std::vector<NamedDomain> periodic_domains() {
  const auto box = [](std::vector<double> low, std::vector<double> high, std::array<bool, 3> axes) {
    return Domain::periodic_box(low, high, std::span(axes).first(low.size()));
  };
  const auto lattice = [](std::vector<double> vectors, std::vector<double> origin) {
    return Domain::lattice(vectors, origin);
  };
  return {{"periodic_xy", box({-1, 2}, {2, 4}, {true, true, false})},
          {"periodic_x", box({-1, 2}, {2, 4}, {true, false, false})},
          {"hexagonal", lattice({1, 0, 0.5, 0.8}, {})},
          {"skew", lattice({1, 0.1, 3.3, 1.2}, {-5, 0.3})},
          {"periodic_xyz", box({0, 0, -1}, {1, 2, 0.5}, {true, true, true})},
          {"periodic_xz", box({0, 0, -1}, {1, 2, 0.5}, {true, false, true})},
          {"periodic_z", box({0, 0, -1}, {1, 2, 0.5}, {false, false, true})},
          {"triclinic", lattice({1, 0, 0, 0.3, 0.9, 0, -0.2, 0.4, 1.1}, {0.5, 0, -2})},
          {"face_centred", lattice({0, 1, 1, 1, 0, 1, 1, 2, 1}, {})}};
}

std::vector<NamedDomain> one_of_each() {
  return {{"islands", Domain::polygon(islands())},
          {"torus", surface_of(torus(12, 7))},
          {"ball", volume_of(ball_tetrahedra(0))},
          {"square", unit_box(2)},
          {"cube", unit_box(3)}};
}

namespace {

/// A point uniform in a simplex of k corners of d coordinates.
void simplex_point(const std::vector<const double*>& corners, int d, Random& random, double* out) {
  std::vector<double> weights;
  double sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    weights.push_back(-std::log(1 - random.uniform()));
    sum += weights.back();
  }
  for (int c = 0; c < d; ++c) out[c] = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    for (int c = 0; c < d; ++c) out[c] += weights[k] / sum * corners[k][c];
}

/// The triangles or tetrahedra of the regions, each with its measure.
struct Simplices {
  std::vector<std::vector<const double*>> corners;
  std::vector<double> cumulative;
};

double simplex_measure(const std::vector<const double*>& v, int d) {
  double e[3][3] = {};
  for (std::size_t k = 1; k < v.size(); ++k)
    for (int c = 0; c < d; ++c) e[k - 1][c] = v[k][c] - v[0][c];
  const double normal[3] = {e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2],
                            e[0][0] * e[1][1] - e[0][1] * e[1][0]};
  if (v.size() == 3)
    return std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]) / 2;
  return std::abs(normal[0] * e[2][0] + normal[1] * e[2][1] + normal[2] * e[2][2]) / 6;
}

Simplices simplices_of(const RegionMesh& mesh) {
  Simplices list;
  const auto d = static_cast<std::size_t>(mesh.dimension);
  const auto vertex = [&](std::size_t k) { return &mesh.vertices[mesh.region_vertex[k] * d]; };
  double sum = 0;
  for (std::size_t r = 0; r < mesh.region_count(); ++r) {
    const std::size_t first = mesh.region_offset[r], last = mesh.region_offset[r + 1];
    if (mesh.shape == RegionShape::tetrahedron) {
      list.corners.push_back({vertex(first), vertex(first + 1), vertex(first + 2), vertex(first + 3)});
      list.cumulative.push_back(sum += simplex_measure(list.corners.back(), 3));
      continue;
    }
    for (std::size_t k = first + 2; k < last; ++k) {
      list.corners.push_back({vertex(first), vertex(k - 1), vertex(k)});
      list.cumulative.push_back(sum += simplex_measure(list.corners.back(), mesh.dimension));
    }
  }
  return list;
}

}  // namespace

std::vector<double> points_in(const Domain& domain, std::size_t n, Random& random) {
  const RegionMesh& mesh = domain.mesh();
  const int d = mesh.dimension;
  std::vector<double> points(n * static_cast<std::size_t>(d));
  if (mesh.shape == RegionShape::box)
    return scatter(Distribution::white, n, d, {domain.low(), domain.high()}, random).positions;
  const Simplices list = simplices_of(mesh);
  for (std::size_t i = 0; i < n; ++i) {
    const double at = random.uniform() * list.cumulative.back();
    const auto found = std::upper_bound(list.cumulative.begin(), list.cumulative.end(), at);
    const auto k = std::min<std::size_t>(static_cast<std::size_t>(found - list.cumulative.begin()),
                                         list.corners.size() - 1);
    simplex_point(list.corners[k], d, random, &points[i * static_cast<std::size_t>(d)]);
  }
  return points;
}

SeedArray seeds_for(const Domain& domain, Distribution distribution, WeightRange range, std::size_t n,
                    Random& random) {
  const int d = domain.dimension();
  if (n == 0) return {d, {}, {}};
  const double h = spacing(domain.measure(), n, domain.cell_dimension());
  SeedArray seeds;
  if (domain.kind() == DomainKind::surface && distribution == Distribution::white) {
    seeds = {d, points_in(domain, n, random), std::vector<double>(n, 0.0)};
    for (double& x : seeds.positions) x += 0.5 * h * random.uniform(-1, 1);
  } else {
    Box box{domain.low(), domain.high()};
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
      const double margin = 0.1 * (box.high[k] - box.low[k]);
      box.low[k] -= margin;
      box.high[k] += margin;
    }
    seeds = scatter(distribution, n, d, box, random);
  }
  set_weights(seeds, range, h, random);
  return seeds;
}

std::vector<SeededDomain> with_seeds(const std::vector<NamedDomain>& domains, std::size_t n) {
  std::vector<SeededDomain> list;
  for (const NamedDomain& named : domains) {
    Random random(test_seed());
    list.push_back({named, seeds_for(named.domain, Distribution::white, WeightRange::W1, n, random)});
  }
  return list;
}

}  // namespace powercell::test
