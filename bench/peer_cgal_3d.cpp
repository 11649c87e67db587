#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <type_traits>
#include <utility>

#include "bench/box_cell.hpp"
#include "bench/peers.hpp"

namespace powercell::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel,
                                                           CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using Cell =
    CGAL::Triangulation_cell_base_with_info_3<Point, Kernel, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
template <class Tag>
using Structure = CGAL::Triangulation_data_structure_3<Vertex, Cell, Tag>;
template <class Tag>
using Triangulation = CGAL::Regular_triangulation_3<Kernel, Structure<Tag>>;

template <class Tag>
constexpr bool is_parallel = std::is_convertible_v<Tag, CGAL::Parallel_tag>;

template <class Tag, class Body>
void for_each_index(std::size_t count, const Body& body) {
  if constexpr (is_parallel<Tag>) {
    tbb::parallel_for(std::size_t{0}, count, body);
  } else {
    for (std::size_t k = 0; k < count; ++k) body(k);
  }
}

/// Computes the dual point of each finite cell and says which seeds' cells reach the box's faces.
template <class Tag>
std::vector<char> place_dual_points(Triangulation<Tag>& t, std::size_t n, const Box& box) {
  std::vector<typename Triangulation<Tag>::Cell_handle> cells;
  for (auto c = t.all_cells_begin(); c != t.all_cells_end(); ++c) cells.push_back(c);
  std::vector<char> inside(cells.size(), 0), cut(n, 0);
  for_each_index<Tag>(cells.size(), [&](std::size_t k) {
    if (t.is_infinite(cells[k])) return;
    const Point x = cells[k]->info() = t.dual(cells[k]);
    inside[k] = x.x() > box.low[0] && x.x() < box.high[0] && x.y() > box.low[1] && x.y() < box.high[1] &&
                x.z() > box.low[2] && x.z() < box.high[2];
  });
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (inside[k]) continue;
    for (int v = 0; v < 4; ++v)
      if (!t.is_infinite(cells[k]->vertex(v))) cut[cells[k]->vertex(v)->info()] = 1;
  }
  return cut;
}

/// Area of the dual polygon of an edge whose cells are all finite.
template <class Tag>
double wall_area(const Triangulation<Tag>& t, const typename Triangulation<Tag>::Edge& edge) {
  auto first = t.incident_cells(edge), at = first;
  const Point origin = at->info();
  Kernel::Vector_3 sum(0, 0, 0), last = (++at)->info() - origin;
  for (++at; at != first; ++at) {
    const Kernel::Vector_3 next = at->info() - origin;
    sum = sum + CGAL::cross_product(last, next);
    last = next;
  }
  return 0.5 * std::sqrt(sum.squared_length());
}

template <class Tag>
std::vector<double> measure_cells(Triangulation<Tag>& t, const SeedsView& seeds, const Box& box) {
  const std::size_t n = seeds.size();
  const std::vector<char> cut = place_dual_points<Tag>(t, n, box);
  std::vector<typename Triangulation<Tag>::Edge> edges;
  std::vector<std::vector<std::uint32_t>> neighbors(n);
  for (auto e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
    const std::uint32_t i = e->first->vertex(e->second)->info(), j = e->first->vertex(e->third)->info();
    if (cut[i]) neighbors[i].push_back(j);
    if (cut[j]) neighbors[j].push_back(i);
    if (!cut[i] || !cut[j]) edges.push_back(*e);
  }
  std::vector<double> areas(edges.size());
  for_each_index<Tag>(edges.size(), [&](std::size_t k) { areas[k] = wall_area<Tag>(t, edges[k]); });

  std::vector<double> measures(n, 0.0);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    // The pyramid of each seed over its face; signed, as a seed may lie outside its cell.
    const auto a = edges[k].first->vertex(edges[k].second), b = edges[k].first->vertex(edges[k].third);
    const double q2 = CGAL::squared_distance(a->point().point(), b->point().point()), q = std::sqrt(q2);
    const double s = (q2 + a->point().weight() - b->point().weight()) / (2 * q);
    if (!cut[a->info()]) measures[a->info()] += areas[k] * s / 3;
    if (!cut[b->info()]) measures[b->info()] += areas[k] * (q - s) / 3;
  }
  for_each_index<Tag>(n, [&](std::size_t i) {
    if (cut[i]) measures[i] = cell_volume_in_box(seeds, i, neighbors[i], box);
  });
  return measures;
}

template <class Tag>
std::vector<std::pair<typename Triangulation<Tag>::Weighted_point, std::uint32_t>> points_of(
    const SeedsView& seeds) {
  std::vector<std::pair<typename Triangulation<Tag>::Weighted_point, std::uint32_t>> points;
  points.reserve(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const double* p = &seeds.positions[3 * i];
    points.emplace_back(
        typename Triangulation<Tag>::Weighted_point(Point(p[0], p[1], p[2]), seeds.weights[i]),
        static_cast<std::uint32_t>(i));
  }
  return points;
}

}  // namespace

std::vector<double> cgal_measures_3d(const SeedsView& seeds, const Box& box) {
  const auto points = points_of<CGAL::Sequential_tag>(seeds);
  Triangulation<CGAL::Sequential_tag> t(points.begin(), points.end());
  return measure_cells<CGAL::Sequential_tag>(t, seeds, box);
}

std::vector<double> cgal_parallel_measures_3d(const SeedsView& seeds, const Box& box) {
  const auto points = points_of<CGAL::Parallel_tag>(seeds);
  const CGAL::Bbox_3 bounds(box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]);
  Triangulation<CGAL::Parallel_tag>::Lock_data_structure locks(bounds, 50);
  Triangulation<CGAL::Parallel_tag> t(points.begin(), points.end(), &locks);
  return measure_cells<CGAL::Parallel_tag>(t, seeds, box);
}

}  // namespace powercell::bench
