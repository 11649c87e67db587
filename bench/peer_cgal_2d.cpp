#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_face_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <utility>

#include "bench/box_cell.hpp"
#include "bench/loops.hpp"
#include "bench/peers.hpp"

namespace powercell::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

/// The dual point of a face and whether it lies inside the box.
struct Dual {
  Point point;
  bool inside = false;
};
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel,
                                                           CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
using Face =
    CGAL::Triangulation_face_base_with_info_2<Dual, Kernel, CGAL::Regular_triangulation_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Regular_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>>;

Triangulation triangulate(const SeedsView& seeds) {
  std::vector<std::pair<Triangulation::Weighted_point, std::uint32_t>> points;
  points.reserve(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i)
    points.emplace_back(Triangulation::Weighted_point(
                            Point(seeds.positions[2 * i], seeds.positions[2 * i + 1]), seeds.weights[i]),
                        static_cast<std::uint32_t>(i));
  return Triangulation(points.begin(), points.end());
}

/// Area of the polygon of the dual points around a vertex; negative if one of them is not inside the box.
double area_of_dual(const Triangulation& t, Triangulation::Vertex_handle vertex) {
  auto first = t.incident_faces(vertex), at = first;
  if (!at->info().inside) return -1;
  const Point origin = at->info().point;
  double last_x = 0, last_y = 0, twice = 0;
  for (++at; at != first; ++at) {
    if (!at->info().inside) return -1;
    const double x = at->info().point.x() - origin.x(), y = at->info().point.y() - origin.y();
    twice += last_x * y - last_y * x;
    last_x = x;
    last_y = y;
  }
  return 0.5 * twice;
}

double area_by_clipping(const Triangulation& t, Triangulation::Vertex_handle vertex, const SeedsView& seeds,
                        const Box& box) {
  std::vector<std::uint32_t> neighbors;
  auto first = t.incident_vertices(vertex), at = first;
  do {
    if (!t.is_infinite(at)) neighbors.push_back(at->info());
  } while (++at != first);
  return cell_area_in_box(seeds, vertex->info(), neighbors, box);
}

template <class Loop>
std::vector<double> measures_2d(const SeedsView& seeds, const Box& box, Loop for_each) {
  Triangulation t = triangulate(seeds);
  std::vector<Triangulation::Face_handle> faces;
  faces.reserve(t.number_of_faces());
  for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f) faces.push_back(f);
  for_each(faces.size(), [&](std::size_t k) {
    const Point x = t.dual(faces[k]);
    faces[k]->info() = {
        x, x.x() > box.low[0] && x.x() < box.high[0] && x.y() > box.low[1] && x.y() < box.high[1]};
  });

  std::vector<Triangulation::Vertex_handle> vertices;
  vertices.reserve(t.number_of_vertices());
  for (auto v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v) vertices.push_back(v);
  std::vector<double> measures(seeds.size(), 0.0);
  for_each(vertices.size(), [&](std::size_t k) {
    const double area = area_of_dual(t, vertices[k]);
    measures[vertices[k]->info()] = area >= 0 ? area : area_by_clipping(t, vertices[k], seeds, box);
  });
  return measures;
}

}  // namespace

std::vector<double> cgal_measures_2d(const SeedsView& seeds, const Box& box) {
  return measures_2d(seeds, box, SerialLoop{});
}

std::vector<double> cgal_parallel_measures_2d(const SeedsView& seeds, const Box& box) {
  return measures_2d(seeds, box, ParallelLoop{});
}

}  // namespace powercell::bench
