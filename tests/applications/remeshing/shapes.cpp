#include "tests/applications/remeshing/shapes.hpp"

#include <cmath>
#include <numbers>

#include "tests/support/meshes.hpp"

namespace powercell::test {

TriangleMesh plate(double thickness) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) {
    const double corner[3] = {k & 1 ? 1.0 : 0.0, k & 2 ? 1.0 : 0.0, k & 4 ? thickness : 0.0};
    mesh.vertices.insert(mesh.vertices.end(), corner, corner + 3);
  }
  mesh.triangles = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return mesh;
}

TriangleMesh cube_of_12() {
  return plate(1);
}

TriangleMesh cone(std::uint32_t sides, double radius) {
  TriangleMesh mesh{{0, 0, 1, 0, 0, 0}, {}};
  for (std::uint32_t k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    mesh.vertices.insert(mesh.vertices.end(), {radius * std::cos(angle), radius * std::sin(angle), 0});
    const std::uint32_t a = 2 + k, b = 2 + (k + 1) % sides;
    mesh.triangles.insert(mesh.triangles.end(), {0, a, b, 1, b, a});
  }
  return mesh;
}

TriangleMesh bumpy_ball() {
  TriangleMesh mesh = sphere(10);
  for (std::size_t k = 0; k < mesh.vertices.size(); k += 3) {
    double* v = &mesh.vertices[k];
    const double r = 1 + 0.2 * std::sin(3 * v[0] + 1) * std::sin(4 * v[1]) + 0.15 * std::cos(5 * v[2]);
    v[0] *= 1.4 * r;
    v[1] *= r;
    v[2] *= 0.8 * r;
  }
  return mesh;
}

TriangleMesh wavy_sheet() {
  const Mesh patch = wavy_patch(24);
  return {patch.vertices, patch.elements};
}

TriangleMesh tube() {
  constexpr std::uint32_t around = 24, rings = 13;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      const double z = i / 6.0, r = 0.5 + 0.15 * std::cos(2 * z), t = 2 * std::numbers::pi * j / around;
      mesh.vertices.insert(mesh.vertices.end(), {r * std::cos(t), r * std::sin(t), z});
    }
  for (std::uint32_t i = 0; i + 1 < rings; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      const std::uint32_t a = i * around + j, b = i * around + (j + 1) % around;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, b + around, a, b + around, a + around});
    }
  return mesh;
}

TriangleMesh small_torus() {
  return powercell::torus(16);
}

std::vector<NamedMesh> smooth_meshes() {
  return {{"ball", sphere(8), 2, 0},
          {"bumpy ball", bumpy_ball(), 2, 0},
          {"torus", small_torus(), 0, 0},
          {"sheet", wavy_sheet(), 1, 1},
          {"tube", tube(), 0, 2}};
}

}  // namespace powercell::test
