#include "tests/pairs/region_meshes.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace powercell::test {
namespace {

using Elements = std::vector<std::vector<std::uint32_t>>;

bool negative(const std::vector<double>& v, const std::vector<std::uint32_t>& t) {
  double e[3][3];
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 3; ++k) e[c][k] = v[t[c + 1] * 3 + k] - v[t[0] * 3 + k];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
             e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
             e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]) <
         0;
}

Elements grouped(const std::vector<std::uint32_t>& flat, std::size_t corners) {
  Elements elements;
  for (std::size_t k = 0; k < flat.size(); k += corners)
    elements.emplace_back(flat.begin() + static_cast<std::ptrdiff_t>(k),
                          flat.begin() + static_cast<std::ptrdiff_t>(k + corners));
  return elements;
}

/// Two triangles for each cell of a grid of (n+1)^2 vertices, numbered from `base` along the first axis.
void add_grid(Elements& elements, std::uint32_t base, std::uint32_t n) {
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = base + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      elements.push_back({a, b, d});
      elements.push_back({a, d, c});
    }
}

}  // namespace

RegionMesh regions(RegionShape shape, int dimension, const std::vector<double>& vertices,
                   const Elements& elements) {
  RegionMesh mesh;
  mesh.shape = shape;
  mesh.dimension = dimension;
  const bool solid = shape != RegionShape::polygon;
  mesh.cell_dimension = solid ? 3 : 2;
  mesh.kind = solid ? DomainKind::volume : dimension == 2 ? DomainKind::polygon : DomainKind::surface;
  mesh.vertices = vertices;
  mesh.region_offset.push_back(0);
  for (std::vector<std::uint32_t> corners : elements) {
    if (shape == RegionShape::tetrahedron && negative(vertices, corners)) std::swap(corners[0], corners[1]);
    mesh.region_vertex.insert(mesh.region_vertex.end(), corners.begin(), corners.end());
    mesh.region_offset.push_back(static_cast<std::uint32_t>(mesh.region_vertex.size()));
    mesh.source.push_back(static_cast<std::uint32_t>(mesh.source.size()));
  }
  return mesh;
}

RegionMesh square_of_triangles(int per_axis) {
  std::vector<double> v;
  for (int j = 0; j <= per_axis; ++j)
    for (int i = 0; i <= per_axis; ++i) {
      v.push_back(static_cast<double>(i) / per_axis);
      v.push_back(static_cast<double>(j) / per_axis);
    }
  Elements elements;
  add_grid(elements, 0, static_cast<std::uint32_t>(per_axis));
  return regions(RegionShape::polygon, 2, v, elements);
}

RegionMesh disc_of_polygons(int corners) {
  std::vector<double> v;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    v.push_back(0.5 + 0.5 * std::cos(angle));
    v.push_back(0.5 + 0.5 * std::sin(angle));
  }
  const auto n = static_cast<std::uint32_t>(corners);
  const auto arc = [&](std::uint32_t from, std::uint32_t to) {
    std::vector<std::uint32_t> ring;
    for (std::uint32_t k = from; k <= to; ++k) ring.push_back(k % n);
    return ring;
  };
  const std::uint32_t a = n / 6, b = n / 2, c = n - 3;
  std::vector<std::uint32_t> middle = arc(a, b);
  for (std::uint32_t k : arc(c, n)) middle.push_back(k);
  return regions(RegionShape::polygon, 2, v, {arc(0, a), middle, arc(b, c)});
}

RegionMesh surface_regions(const Mesh& mesh) {
  return regions(RegionShape::polygon, 3, mesh.vertices, grouped(mesh.elements, 3));
}

RegionMesh volume_regions(const Mesh& mesh) {
  return regions(RegionShape::tetrahedron, 3, mesh.vertices, grouped(mesh.elements, 4));
}

RegionMesh boxes(int per_axis) {
  const auto n = static_cast<std::uint32_t>(per_axis), m = n + 1;
  std::vector<double> v;
  for (std::uint32_t k = 0; k < m * m * m; ++k)
    for (std::uint32_t x : {k % m, k / m % m, k / m / m}) v.push_back(static_cast<double>(x) / per_axis);
  Elements elements;
  for (std::uint32_t z = 0; z < n; ++z)
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) {
        std::vector<std::uint32_t> box;
        for (std::uint32_t k = 0; k < 8; ++k)
          box.push_back(((z + (k >> 2)) * m + y + (k >> 1 & 1)) * m + x + (k & 1));
        elements.push_back(box);
      }
  return regions(RegionShape::box, 3, v, elements);
}

RegionMesh triangle_soup(std::size_t count, Random& random) {
  std::vector<double> v;
  std::vector<std::uint32_t> flat;
  for (std::size_t t = 0; t < count; ++t) {
    const double size = std::pow(10.0, random.uniform(-3, 0)), thin = std::pow(10.0, random.uniform(-4, 0));
    double at[3], along[3], across[3];
    for (int k = 0; k < 3; ++k) {
      at[k] = random.uniform();
      along[k] = size * random.uniform(-1, 1);
      across[k] = size * thin * random.uniform(-1, 1);
    }
    for (int c = 0; c < 3; ++c) {
      flat.push_back(static_cast<std::uint32_t>(v.size() / 3));
      for (int k = 0; k < 3; ++k) v.push_back(at[k] + (c == 1 ? along[k] : c == 2 ? across[k] : 0));
    }
  }
  return regions(RegionShape::polygon, 3, v, grouped(flat, 3));
}

RegionMesh cube_surface(int per_axis) {
  std::vector<double> v;
  Elements elements;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {0.2, 0.8}) {
      const auto base = static_cast<std::uint32_t>(v.size() / 3);
      for (int j = 0; j <= per_axis; ++j)
        for (int i = 0; i <= per_axis; ++i) {
          double p[3];
          p[axis] = side;
          p[(axis + 1) % 3] = 0.2 + 0.6 * i / per_axis;
          p[(axis + 2) % 3] = 0.2 + 0.6 * j / per_axis;
          v.insert(v.end(), p, p + 3);
        }
      add_grid(elements, base, static_cast<std::uint32_t>(per_axis));
    }
  return regions(RegionShape::polygon, 3, v, elements);
}

void transform(RegionMesh& mesh, double s, double by) {
  for (double& x : mesh.vertices) x = s * x + by;
}

}  // namespace powercell::test
