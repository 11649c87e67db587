#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_face_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cmath>
#include <utility>

#include "bench/box_cell.hpp"
#include "bench/peers.hpp"

namespace powercell::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel,
                                                           CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
using Face =
    CGAL::Triangulation_face_base_with_info_2<Point, Kernel, CGAL::Regular_triangulation_face_base_2<Kernel>>;
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

/// Computes the dual point of each finite face and says which seeds' cells reach the box's sides.
std::vector<char> place_dual_points(Triangulation& t, std::size_t n, const Box& box) {
  std::vector<char> cut(n, 0);
  for (auto f = t.all_faces_begin(); f != t.all_faces_end(); ++f) {
    bool inside = false;
    if (!t.is_infinite(f)) {
      const Point x = f->info() = t.dual(f);
      inside = x.x() > box.low[0] && x.x() < box.high[0] && x.y() > box.low[1] && x.y() < box.high[1];
    }
    if (inside) continue;
    for (int k = 0; k < 3; ++k)
      if (!t.is_infinite(f->vertex(k))) cut[f->vertex(k)->info()] = 1;
  }
  return cut;
}

}  // namespace

std::vector<double> cgal_measures_2d(const SeedsView& seeds, const Box& box) {
  Triangulation t = triangulate(seeds);
  const std::vector<char> cut = place_dual_points(t, seeds.size(), box);
  std::vector<double> measures(seeds.size(), 0.0);
  std::vector<std::vector<std::uint32_t>> neighbors(seeds.size());
  for (auto e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
    const auto face = e->first, other = face->neighbor(e->second);
    const auto a = face->vertex(t.cw(e->second)), b = face->vertex(t.ccw(e->second));
    const std::uint32_t i = a->info(), j = b->info();
    if (cut[i]) neighbors[i].push_back(j);
    if (cut[j]) neighbors[j].push_back(i);
    if (cut[i] && cut[j]) continue;
    // The triangle of each seed with its side of the cell; signed, as a seed may lie outside its cell.
    const double q2 = CGAL::squared_distance(a->point().point(), b->point().point()), q = std::sqrt(q2);
    const double wall = std::sqrt(CGAL::squared_distance(face->info(), other->info()));
    const double s = (q2 + a->point().weight() - b->point().weight()) / (2 * q);
    if (!cut[i]) measures[i] += 0.5 * wall * s;
    if (!cut[j]) measures[j] += 0.5 * wall * (q - s);
  }
  for (std::size_t i = 0; i < seeds.size(); ++i)
    if (cut[i]) measures[i] = cell_area_in_box(seeds, i, neighbors[i], box);
  return measures;
}

}  // namespace powercell::bench
