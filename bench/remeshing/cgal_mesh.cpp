#include "bench/remeshing/cgal_mesh.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <stdexcept>

#include "bench/clocks.hpp"

namespace powercell::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;
namespace named = CGAL::parameters;

/// \throw std::runtime_error if CGAL cannot make a mesh of the triangles
Mesh mesh_of(const TriangleMesh& input) {
  std::vector<Kernel::Point_3> points;
  for (std::size_t v = 0; v < input.vertices.size(); v += 3)
    points.emplace_back(input.vertices[v], input.vertices[v + 1], input.vertices[v + 2]);
  std::vector<std::vector<std::size_t>> faces;
  for (std::size_t t = 0; t < input.triangles.size(); t += 3)
    faces.push_back({input.triangles[t], input.triangles[t + 1], input.triangles[t + 2]});
  if (!pmp::is_polygon_soup_a_polygon_mesh(faces)) throw std::runtime_error("not an oriented manifold");
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, faces, mesh);
  return mesh;
}

TriangleMesh arrays_of(Mesh& mesh) {
  mesh.collect_garbage();
  TriangleMesh result;
  for (const auto v : mesh.vertices())
    for (int k = 0; k < 3; ++k) result.vertices.push_back(mesh.point(v)[k]);
  for (const auto f : mesh.faces())
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      result.triangles.push_back(static_cast<std::uint32_t>(v.idx()));
  return result;
}

double distance(const Mesh& from, const Mesh& to) {
  return pmp::max_distance_to_triangle_mesh<CGAL::Sequential_tag>(
      [&] {
        std::vector<Kernel::Point_3> points;
        pmp::sample_triangle_mesh(from, std::back_inserter(points),
                                  named::use_random_uniform_sampling(true).number_of_points_on_faces(200000));
        return points;
      }(),
      to);
}

}  // namespace

MeshVerdict check_by_cgal(const TriangleMesh& input, const TriangleMesh& mesh) {
  MeshVerdict verdict;
  const Mesh before = mesh_of(input);
  Mesh after;
  try {
    after = mesh_of(mesh);
  } catch (const std::runtime_error&) {
    return verdict;
  }
  verdict.valid = CGAL::is_valid_polygon_mesh(after) && CGAL::is_triangle_mesh(after);
  verdict.self_intersecting = pmp::does_self_intersect(after);
  verdict.euler = static_cast<int>(after.number_of_vertices()) - static_cast<int>(after.number_of_edges()) +
                  static_cast<int>(after.number_of_faces());
  std::vector<Mesh::Halfedge_index> loops;
  pmp::extract_boundary_cycles(after, std::back_inserter(loops));
  verdict.boundary_loops = static_cast<int>(loops.size());
  verdict.mesh_to_input = distance(after, before);
  verdict.input_to_mesh = distance(before, after);
  return verdict;
}

TriangleMesh remesh_by_cgal(const TriangleMesh& input, std::size_t count, int iterations, double sharp_angle,
                            double& seconds) {
  const Mesh original = mesh_of(input);
  double length = std::sqrt(pmp::area(original) / (static_cast<double>(count) * std::sqrt(3.0) / 2));
  for (int attempt = 0;; ++attempt) {
    Mesh mesh = original;
    const double start = processor_seconds();
    auto sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
    pmp::detect_sharp_edges(mesh, sharp_angle, sharp);
    for (const auto e : mesh.edges())
      if (mesh.is_border(e)) sharp[e] = true;
    std::vector<Mesh::Edge_index> kept;
    for (const auto e : mesh.edges())
      if (sharp[e]) kept.push_back(e);
    if (!kept.empty()) pmp::split_long_edges(kept, length, mesh, named::edge_is_constrained_map(sharp));
    pmp::isotropic_remeshing(
        mesh.faces(), length, mesh,
        named::number_of_iterations(iterations).edge_is_constrained_map(sharp).protect_constraints(true));
    seconds = processor_seconds() - start;
    TriangleMesh result = arrays_of(mesh);
    const double ratio = static_cast<double>(result.vertices.size() / 3) / static_cast<double>(count);
    if (std::fabs(ratio - 1) < 0.01 || attempt == 6) return result;
    length *= std::sqrt(ratio);
  }
}

}  // namespace powercell::bench
