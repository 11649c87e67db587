#include <powercell/c/shapes.h>

#include <memory>
#include <powercell/shapes.hpp>

#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

pc_status triangles(TriangleMesh (*shape)(int), int resolution, const pc_triangle_mesh** mesh) {
  return guarded([&] {
    result_at(mesh);
    hand_over_result(mesh, shape(resolution), [](pc_triangle_mesh& to, const TriangleMesh& from) {
      to.vertex_count = from.vertices.size() / 3;
      to.triangle_count = from.triangles.size() / 3;
      to.vertices = pointer(from.vertices);
      to.triangles = pointer(from.triangles);
    });
  });
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_shape_disk(int segments, double* points) {
  return guarded([&] {
    result_at(points);
    for (const auto& point : disk(segments)) points = std::copy(point.begin(), point.end(), points);
  });
}

pc_status pc_shape_sphere(int resolution, const pc_triangle_mesh** mesh) {
  return triangles(&sphere, resolution, mesh);
}

pc_status pc_shape_torus(int resolution, const pc_triangle_mesh** mesh) {
  return triangles(&torus, resolution, mesh);
}

pc_status pc_shape_ball(int resolution, const pc_tetrahedral_mesh** mesh) {
  return guarded([&] {
    result_at(mesh);
    hand_over_result(mesh, ball(resolution), [](pc_tetrahedral_mesh& to, const TetrahedralMesh& from) {
      to.vertex_count = from.vertices.size() / 3;
      to.tetrahedron_count = from.tetrahedra.size() / 4;
      to.vertices = pointer(from.vertices);
      to.tetrahedra = pointer(from.tetrahedra);
    });
  });
}

void pc_triangle_mesh_destroy(const pc_triangle_mesh* mesh) {
  destroy_result<TriangleMesh>(mesh);
}

void pc_tetrahedral_mesh_destroy(const pc_tetrahedral_mesh* mesh) {
  destroy_result<TetrahedralMesh>(mesh);
}

}  // extern "C"
