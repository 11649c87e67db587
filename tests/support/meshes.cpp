#include "tests/support/meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace powercell::test {

namespace {

std::uint32_t add_vertex(Mesh& mesh, double x, double y, double z) {
  mesh.vertices.insert(mesh.vertices.end(), {x, y, z});
  return static_cast<std::uint32_t>(mesh.vertex_count() - 1);
}

std::uint32_t add_on_sphere(Mesh& mesh, double x, double y, double z) {
  const double r = std::sqrt(x * x + y * y + z * z);
  return add_vertex(mesh, x / r, y / r, z / r);
}

Mesh icosahedron() {
  Mesh mesh;
  const double g = std::numbers::phi;
  const double corners[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (const auto& c : corners) add_on_sphere(mesh, c[0], c[1], c[2]);
  mesh.elements = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                   4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                   6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  return mesh;
}

/// Two triangles per cell of a grid of vertices index(i, j).
template <class Index>
void add_grid_triangles(Mesh& mesh, int rows, int columns, Index index) {
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const std::uint32_t a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      mesh.elements.insert(mesh.elements.end(), {a, b, c, a, c, d});
    }
}

}  // namespace

Mesh icosphere(int subdivisions) {
  Mesh mesh = icosahedron();
  for (int s = 0; s < subdivisions; ++s) {
    Mesh finer{mesh.vertices, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto middle_of = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, fresh] = middle.try_emplace(std::minmax(a, b), 0);
      if (fresh) {
        const double* p = &mesh.vertices[3 * a];
        const double* q = &mesh.vertices[3 * b];
        entry->second = add_on_sphere(finer, p[0] + q[0], p[1] + q[1], p[2] + q[2]);
      }
      return entry->second;
    };
    for (std::size_t t = 0; t < mesh.elements.size(); t += 3) {
      const std::uint32_t a = mesh.elements[t], b = mesh.elements[t + 1], c = mesh.elements[t + 2];
      const std::uint32_t ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
      finer.elements.insert(finer.elements.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
    }
    mesh = std::move(finer);
  }
  return mesh;
}

Mesh torus(int around, int across) {
  Mesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = 1 + 0.4 * std::cos(v);
      add_vertex(mesh, r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v));
    }
  add_grid_triangles(mesh, around, across, [&](int i, int j) {
    return static_cast<std::uint32_t>((i % around) * across + j % across);
  });
  return mesh;
}

Mesh wavy_patch(int per_axis) {
  Mesh mesh;
  for (int i = 0; i <= per_axis; ++i)
    for (int j = 0; j <= per_axis; ++j) {
      const double x = static_cast<double>(i) / per_axis, y = static_cast<double>(j) / per_axis;
      add_vertex(mesh, x, y, 0.2 * std::sin(5 * x) * std::cos(4 * y));
    }
  add_grid_triangles(mesh, per_axis, per_axis,
                     [&](int i, int j) { return static_cast<std::uint32_t>(i * (per_axis + 1) + j); });
  return mesh;
}

Mesh book(int pages) {
  Mesh mesh;
  const std::uint32_t bottom = add_vertex(mesh, 0, 0, 0), top = add_vertex(mesh, 0, 0, 1);
  for (int k = 0; k < pages; ++k) {
    const double angle = 0.3 + 2 * std::numbers::pi * k / pages;
    const std::uint32_t low = add_vertex(mesh, std::cos(angle), std::sin(angle), 0);
    const std::uint32_t high = add_vertex(mesh, std::cos(angle), std::sin(angle), 1);
    mesh.elements.insert(mesh.elements.end(), {bottom, low, high, bottom, high, top});
  }
  return mesh;
}

Mesh cube_tetrahedra(int per_axis, double jitter, Random& random) {
  Mesh mesh;
  const int m = per_axis + 1;
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i) {
        double x[3] = {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        for (double& c : x)
          if (c > 0 && c < per_axis) c += jitter * random.uniform(-1, 1);
        add_vertex(mesh, x[0] / per_axis, x[1] / per_axis, x[2] / per_axis);
      }
  // Kuhn's subdivision: a tetrahedron for each order of the three axes.
  static constexpr int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int k = 0; k < per_axis; ++k)
    for (int j = 0; j < per_axis; ++j)
      for (int i = 0; i < per_axis; ++i)
        for (const auto& axes : order) {
          std::array<int, 3> at{i, j, k};
          std::array<std::uint32_t, 4> corner;
          for (std::size_t c = 0; c < 4; ++c) {
            corner[c] = static_cast<std::uint32_t>((at[2] * m + at[1]) * m + at[0]);
            if (c < 3) ++at[static_cast<std::size_t>(axes[c])];
          }
          if (mesh.elements.size() / 4 % 2) std::swap(corner[2], corner[3]);
          mesh.elements.insert(mesh.elements.end(), corner.begin(), corner.end());
        }
  return mesh;
}

Mesh ball_tetrahedra(int subdivisions) {
  Mesh mesh = icosphere(subdivisions);
  const std::vector<std::uint32_t> triangles = std::move(mesh.elements);
  mesh.elements.clear();
  const std::uint32_t center = add_vertex(mesh, 0, 0, 0);
  for (std::size_t t = 0; t < triangles.size(); t += 3)
    mesh.elements.insert(mesh.elements.end(), {center, triangles[t], triangles[t + 1], triangles[t + 2]});
  return mesh;
}

Mesh part_of(Mesh mesh, const std::function<bool(const std::array<double, 3>&)>& keep) {
  std::vector<std::uint32_t> elements;
  for (std::size_t e = 0; e < mesh.elements.size(); e += 4) {
    std::array<double, 3> centroid{};
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < 3; ++k) centroid[k] += mesh.vertices[3 * mesh.elements[e + c] + k] / 4;
    if (keep(centroid))
      elements.insert(elements.end(), mesh.elements.begin() + static_cast<std::ptrdiff_t>(e),
                      mesh.elements.begin() + static_cast<std::ptrdiff_t>(e + 4));
  }
  mesh.elements = std::move(elements);
  return mesh;
}

}  // namespace powercell::test
