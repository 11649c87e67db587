#include "tests/support/cgal_solid.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <cmath>

namespace powercell::test {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

Surface surface_of(const Mesh& mesh) {
  Surface surface;
  std::vector<Surface::Vertex_index> vertex;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const double* const x = &mesh.vertices[3 * v];
    vertex.push_back(surface.add_vertex(Point(x[0], x[1], x[2])));
  }
  for (std::size_t t = 0; t < mesh.elements.size(); t += 3)
    surface.add_face(vertex[mesh.elements[t]], vertex[mesh.elements[t + 1]], vertex[mesh.elements[t + 2]]);
  return surface;
}

/// The points that seed i keeps are on its negative side.
Kernel::Plane_3 bisector(const SeedsView& seeds, std::size_t i, std::size_t j) {
  const auto weight = [&](std::size_t k) { return seeds.weights.empty() ? 0.0 : seeds.weights[k]; };
  Kernel::FT normal[3], offset = Kernel::FT(weight(j)) - weight(i);
  for (std::size_t k = 0; k < 3; ++k) {
    const Kernel::FT a = seeds.positions[3 * i + k], b = seeds.positions[3 * j + k];
    normal[k] = 2 * (b - a);
    offset += a * a - b * b;
  }
  return {normal[0], normal[1], normal[2], offset};
}

Surface cell_of(const SeedsView& seeds, std::size_t i) {
  const auto corner = [](int x, int y, int z) { return Point(8 * x - 4, 8 * y - 4, 8 * z - 4); };
  Surface cell;
  CGAL::make_hexahedron(corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0), corner(0, 1, 1),
                        corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), cell);
  PMP::triangulate_faces(cell);
  for (std::size_t j = 0; j < seeds.size() && !cell.is_empty(); ++j)
    if (j != i) PMP::clip(cell, bisector(seeds, i, j), CGAL::parameters::clip_volume(true));
  return cell;
}

double area_of(const Surface& surface) {
  double area = 0;
  for (const auto face : surface.faces()) {
    const auto h = surface.halfedge(face);
    const Point &a = surface.point(surface.source(h)), &b = surface.point(surface.target(h)),
                &c = surface.point(surface.target(surface.next(h)));
    area += std::sqrt(CGAL::to_double(CGAL::squared_area(a, b, c)));
  }
  return area;
}

}  // namespace

CutSolid cut_solid(const Mesh& mesh, const SeedsView& seeds, std::size_t i) {
  Surface cell = cell_of(seeds, i), solid = surface_of(mesh), part;
  if (cell.is_empty()) return {};
  CutSolid cut;
  cut.known = PMP::corefine_and_compute_intersection(cell, solid, part);
  if (!cut.known || part.is_empty()) return cut;
  cut.volume = CGAL::to_double(PMP::volume(part));
  cut.area = area_of(part);
  return cut;
}

}  // namespace powercell::test
