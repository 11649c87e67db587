#include "tests/periodic/brute_force.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace powercell::test {
namespace {

Vec sum_of(const PeriodicSpace& space, const ImageShift& shift) {
  Vec sum;
  for (std::size_t k = 0; k < 3; ++k)
    sum = sum + static_cast<Real>(shift[k]) * Vec{space.vector[k][0], space.vector[k][1], space.vector[k][2]};
  return sum;
}

Vec position(const SeedArray& seeds, std::size_t i) {
  return {seeds.coordinate(i, 0), seeds.coordinate(i, 1), seeds.dimension == 3 ? seeds.coordinate(i, 2) : 0};
}

bool is_periodic(const PeriodicSpace& space, int k) {
  const auto& v = space.vector[static_cast<std::size_t>(k)];
  return v[0] != 0 || v[1] != 0 || v[2] != 0;
}

/// The start of a cell, relative to its seed: bounded axes as in the domain, others far beyond any cell.
void start_box(const PeriodicSpace& space, const Vec& p, Real (&low)[3], Real (&high)[3]) {
  Real far = 1;
  for (const auto& v : space.vector) far += std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
  const Real at[3] = {p.x, p.y, p.z};
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const bool bounded = !is_periodic(space, k);
    low[k] = bounded ? space.box.low[axis] - at[k] : -2 * far;
    high[k] = bounded ? space.box.high[axis] - at[k] : 2 * far;
  }
}

Polygon start_polygon(const PeriodicSpace& space, const Vec& p) {
  Real low[3], high[3];
  start_box(space, p, low, high);
  Polygon polygon;
  polygon.vertices = {{low[0], low[1], 0}, {high[0], low[1], 0}, {high[0], high[1], 0}, {low[0], high[1], 0}};
  for (std::uint32_t k = 0; k < 4; ++k) polygon.border.push_back({Border::Kind::boundary, k});
  return polygon;
}

Polyhedron start_polyhedron(const PeriodicSpace& space, const Vec& p) {
  Real low[3], high[3];
  start_box(space, p, low, high);
  Polyhedron box;
  for (unsigned c = 0; c < 8; ++c)
    box.vertices.push_back({c & 1 ? high[0] : low[0], c & 2 ? high[1] : low[1], c & 4 ? high[2] : low[2]});
  const std::vector<std::uint32_t> ring[6] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                              {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (std::uint32_t f = 0; f < 6; ++f) box.faces.push_back({ring[f], {Border::Kind::boundary, f}});
  return box;
}

/// Calls use(j, shift, q, offset) for all images but the seed itself: points y nearer to seed i have 2 q.y <=
/// offset. Shifts are between the positions given, about the nearest image.
template <class Use>
void for_images(const PeriodicSpace& space, const SeedArray& seeds, std::size_t i, const Use& use) {
  const Vec p = position(seeds, i);
  for (std::uint32_t j = 0; j < seeds.size(); ++j) {
    // The seeds are some periods outside; the images tried are about those in the same part of space.
    const Vec apart = position(seeds, j) - p;
    const Vec a = sum_of(space, {1, 0, 0}), b = sum_of(space, {0, 1, 0}), c = sum_of(space, {0, 0, 1});
    const auto along = [&](const Vec& v, const Vec& u, const Vec& w) {
      if (dot(v, v) == 0) return 0;
      // A vector that is normal to the other two measures steps along v.
      Vec n = space.dimension == 2 ? Vec{-(dot(u, u) > 0 ? u : Vec{-v.y, v.x, 0}).y,
                                         (dot(u, u) > 0 ? u : Vec{-v.y, v.x, 0}).x, 0}
                                   : (dot(u, u) > 0 && dot(w, w) > 0 ? cross(u, w) : v);
      return static_cast<int>(std::lround(dot(n, apart) / dot(n, v)));
    };
    const ImageShift middle{-along(a, b, c), -along(b, a, c), space.dimension == 3 ? -along(c, a, b) : 0};
    ImageShift s;
    for (s[0] = middle[0] - space.most[0]; s[0] <= middle[0] + space.most[0]; ++s[0])
      for (s[1] = middle[1] - space.most[1]; s[1] <= middle[1] + space.most[1]; ++s[1])
        for (s[2] = middle[2] - space.most[2]; s[2] <= middle[2] + space.most[2]; ++s[2]) {
          if (j == i && s == ImageShift{}) continue;
          const Vec q = apart + sum_of(space, s);
          use(j, s, q, dot(q, q) + static_cast<Real>(seeds.weights[i]) - seeds.weights[j]);
        }
  }
}

/// \tparam Shape  Polygon or Polyhedron
template <class Shape, class Measure>
PeriodicCell cell_of(const PeriodicSpace& space, const SeedArray& seeds, std::size_t i, Shape cell,
                     const Measure& add_walls) {
  std::vector<std::pair<std::uint32_t, ImageShift>> image;
  for_images(space, seeds, i, [&](std::uint32_t j, const ImageShift& s, const Vec& q, Real offset) {
    if (cell.empty()) return;
    const HalfSpace half{2.0L * q, offset};
    bool cuts = false;
    for (const Vec& y : cell.vertices) cuts = cuts || half.excess(y) > 0;
    if (!cuts) return;
    cell = clip(cell, half, {Border::Kind::wall, static_cast<std::uint32_t>(image.size())});
    image.emplace_back(j, s);
  });
  PeriodicCell result;
  if (cell.empty()) return result;
  result.moments = moments(cell);
  add_walls(cell, image, result);
  return result;
}

}  // namespace

Domain PeriodicSpace::domain() const {
  const auto d = static_cast<std::size_t>(dimension);
  bool axes = true;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t c = 0; c < 3; ++c) axes = axes && (c == k || vector[k][c] == 0);
  if (!axes) {
    std::vector<double> rows;
    for (std::size_t k = 0; k < d; ++k)
      rows.insert(rows.end(), vector[k].begin(), vector[k].begin() + dimension);
    return Domain::lattice(rows);
  }
  std::array<double, 3> high = box.high;
  bool periodic[3];
  for (std::size_t k = 0; k < d; ++k) periodic[k] = vector[k][k] != 0;
  return Domain::periodic_box(std::span(box.low).first(d), std::span(high).first(d),
                              std::span(periodic).first(d));
}

Real PeriodicSpace::measure() const {
  const auto edge = [&](std::size_t k) {
    Vec v{vector[k][0], vector[k][1], vector[k][2]};
    const Real bounded = static_cast<Real>(box.high[k]) - box.low[k];
    if (!is_periodic(*this, static_cast<int>(k)))
      v = {k == 0 ? bounded : 0, k == 1 ? bounded : 0, k == 2 ? bounded : 0};
    return v;
  };
  return std::abs(dot(edge(0), cross(edge(1), dimension == 3 ? edge(2) : Vec{0, 0, 1})));
}

PeriodicSpace periodic_box_space(int dimension, const Box& box, std::array<bool, 3> periodic, int most) {
  PeriodicSpace space;
  space.dimension = dimension;
  space.box = box;
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
    if (!periodic[k]) continue;
    space.vector[k][k] = box.high[k] - box.low[k];
    space.most[k] = most;
  }
  return space;
}

PeriodicSpace lattice_space(std::array<std::array<double, 3>, 3> vectors, int dimension, int most) {
  PeriodicSpace space;
  space.dimension = dimension;
  space.vector = vectors;
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) space.most[k] = most;
  return space;
}

std::vector<PeriodicCell> periodic_cells(const PeriodicSpace& space, const SeedArray& seeds) {
  std::vector<PeriodicCell> cells;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Vec p = position(seeds, i);
    if (space.dimension == 2)
      cells.push_back(cell_of(space, seeds, i, start_polygon(space, p),
                              [](const Polygon& cell, const auto& image, PeriodicCell& result) {
                                for (std::size_t k = 0; k < cell.border.size(); ++k)
                                  if (cell.border[k].kind == Border::Kind::wall)
                                    result.wall[image[cell.border[k].index]] += edge_length(cell, k);
                              }));
    else
      cells.push_back(cell_of(space, seeds, i, start_polyhedron(space, p),
                              [](const Polyhedron& cell, const auto& image, PeriodicCell& result) {
                                for (std::size_t f = 0; f < cell.faces.size(); ++f)
                                  if (cell.faces[f].border.kind == Border::Kind::wall)
                                    result.wall[image[cell.faces[f].border.index]] += face_area(cell, f);
                              }));
  }
  return cells;
}

SeedArray periodic_seeds(const PeriodicSpace& space, std::size_t n, Random& random) {
  SeedArray seeds;
  seeds.dimension = space.dimension;
  for (std::size_t i = 0; i < n; ++i) {
    std::array<double, 3> x = space.box.low;
    for (int k = 0; k < space.dimension; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      if (!is_periodic(space, k)) {
        x[axis] = random.uniform(space.box.low[axis], space.box.high[axis]);
        continue;
      }
      const double along = random.uniform() + static_cast<double>(random.index(5)) - 2;
      for (std::size_t c = 0; c < 3; ++c) x[c] += along * space.vector[axis][c];
    }
    seeds.positions.insert(seeds.positions.end(), x.begin(), x.begin() + space.dimension);
    seeds.weights.push_back(0);
  }
  return seeds;
}

void check_periodic(Diagram& diagram, const PeriodicSpace& space, const SeedArray& seeds,
                    const std::vector<PeriodicCell>& expected, double tolerance) {
  const auto d = static_cast<std::size_t>(space.dimension);
  const double mean = static_cast<double>(space.measure()) / static_cast<double>(seeds.size());
  const double length = std::pow(mean, 1.0 / space.dimension);
  double extent = 0;
  for (const auto& v : space.vector) extent += std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
  diagram.compute(true, true);
  const Measures& measures = diagram.measures();
  CHECK(std::abs(measures.total() / static_cast<double>(space.measure()) - 1) < tolerance);
  CHECK(measures.domain_measure == doctest::Approx(static_cast<double>(space.measure())).epsilon(1e-14));
  const Adjacency& adjacency = diagram.adjacency();
  REQUIRE(adjacency.shift.size() == adjacency.neighbor.size());
  const Cells& cells = diagram.cells();
  REQUIRE(cells.shift.size() == cells.border.size());
  double largest = 0;
  for (const PeriodicCell& cell : expected)
    for (const auto& [image, wall] : cell.wall) largest = std::max(largest, static_cast<double>(wall));
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    CAPTURE(i);
    const Moments& m = expected[i].moments;
    CHECK(std::abs(measures.mass[i] - static_cast<double>(m.measure)) < tolerance * mean);
    CHECK((measures.status[i] == SeedStatus::ok) == (m.measure > 0));
    auto left = expected[i].wall;
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k) {
      const auto found = left.find({adjacency.neighbor[k], adjacency.shift[k]});
      const double wall = found == left.end() ? 0 : static_cast<double>(found->second);
      CHECK_MESSAGE(std::abs(wall - adjacency.wall[k]) < 1e3 * tolerance * largest,
                    "with " << adjacency.neighbor[k] << " shift " << adjacency.shift[k][0] << " "
                            << adjacency.shift[k][1] << " " << adjacency.shift[k][2] << ": "
                            << adjacency.wall[k] << ", should be " << wall);
      if (found != left.end()) left.erase(found);
      if (k > adjacency.offset[i])
        CHECK(std::pair(adjacency.neighbor[k - 1], adjacency.shift[k - 1]) <
              std::pair(adjacency.neighbor[k], adjacency.shift[k]));
    }
    for (const auto& missing : left) {
      const auto& image = missing.first;
      const auto wall = static_cast<double>(missing.second);
      CHECK_MESSAGE(wall < 1e3 * tolerance * largest,
                    "missing: with " << image.first << " shift " << image.second[0] << " " << image.second[1]
                                     << " " << image.second[2] << ": " << wall);
    }
    if (!(m.measure > 1e-3L * mean)) continue;
    const Real c[3] = {m.first.x, m.first.y, m.first.z};
    for (std::size_t k = 0; k < d; ++k)
      CHECK(std::abs(measures.centroid[i * d + k] - seeds.positions[i * d + k] -
                     static_cast<double>(c[k] / m.measure)) < 1e3 * tolerance * (length + extent));
    // The vertices of each face of the cell lie halfway, in power distance, to the image that it names.
    REQUIRE(cells.cell_offset[i + 1] == cells.cell_offset[i] + 1);
    const std::uint64_t p = cells.cell_offset[i];
    for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
      if (cells.border[f].kind != Border::Kind::wall) continue;
      const std::uint64_t v =
          cells.vertex_offset[p] + (d == 2 ? f - cells.face_offset[p] : cells.loop[cells.loop_offset[f]]);
      Vec y{cells.vertices[v * d], cells.vertices[v * d + 1], d == 3 ? cells.vertices[v * d + 2] : 0};
      const std::uint32_t j = cells.border[f].index;
      const Vec to_i = y - position(seeds, i),
                to_j = y - (position(seeds, j) + sum_of(space, cells.shift[f]));
      const Real difference = dot(to_i, to_i) - seeds.weights[i] - dot(to_j, to_j) + seeds.weights[j];
      CHECK(std::abs(static_cast<double>(difference)) < 1e3 * tolerance * (extent * extent + 1e-300));
    }
  }
}

}  // namespace powercell::test
