#include "tests/support/cgal.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <utility>

namespace powercell::test {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

using VertexBase2 =
    CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
using Structure2 =
    CGAL::Triangulation_data_structure_2<VertexBase2, CGAL::Regular_triangulation_face_base_2<Kernel>>;
using Triangulation2 = CGAL::Regular_triangulation_2<Kernel, Structure2>;

using VertexBase3 =
    CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using Structure3 =
    CGAL::Triangulation_data_structure_3<VertexBase3, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Triangulation3 = CGAL::Regular_triangulation_3<Kernel, Structure3>;

Kernel::Weighted_point_2 weighted(const SeedsView& seeds, std::size_t i, Triangulation2*) {
  const double* p = &seeds.positions[2 * i];
  return {Kernel::Point_2(p[0], p[1]), seeds.weights.empty() ? 0.0 : seeds.weights[i]};
}

Kernel::Weighted_point_3 weighted(const SeedsView& seeds, std::size_t i, Triangulation3*) {
  const double* p = &seeds.positions[3 * i];
  return {Kernel::Point_3(p[0], p[1], p[2]), seeds.weights.empty() ? 0.0 : seeds.weights[i]};
}

template <class Triangulation>
Triangulation triangulate(const SeedsView& seeds) {
  std::vector<std::pair<typename Triangulation::Weighted_point, std::uint32_t>> points;
  points.reserve(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i)
    points.emplace_back(weighted(seeds, i, static_cast<Triangulation*>(nullptr)),
                        static_cast<std::uint32_t>(i));
  return Triangulation(points.begin(), points.end());
}

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Edges finite_edges(const Triangulation2& t) {
  Edges edges;
  for (auto e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e)
    edges.emplace_back(e->first->vertex(t.cw(e->second))->info(), e->first->vertex(t.ccw(e->second))->info());
  return edges;
}

Edges finite_edges(const Triangulation3& t) {
  Edges edges;
  for (auto e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e)
    edges.emplace_back(e->first->vertex(e->second)->info(), e->first->vertex(e->third)->info());
  return edges;
}

std::vector<std::uint32_t> finite_simplices(const Triangulation2& t) {
  std::vector<std::uint32_t> simplices;
  if (t.dimension() < 2) return simplices;
  for (auto f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f)
    for (int k = 0; k < 3; ++k) simplices.push_back(f->vertex(k)->info());
  return simplices;
}

std::vector<std::uint32_t> finite_simplices(const Triangulation3& t) {
  std::vector<std::uint32_t> simplices;
  if (t.dimension() < 3) return simplices;
  for (auto c = t.finite_cells_begin(); c != t.finite_cells_end(); ++c)
    for (int k = 0; k < 4; ++k) simplices.push_back(c->vertex(k)->info());
  return simplices;
}

void fill_rows(RegularTriangulation& result, Edges edges, std::size_t n) {
  const std::size_t count = edges.size();
  for (std::size_t e = 0; e < count; ++e) edges.emplace_back(edges[e].second, edges[e].first);
  std::sort(edges.begin(), edges.end());
  result.offset.assign(n + 1, 0);
  for (const auto& [from, to] : edges) {
    ++result.offset[from + 1];
    result.neighbor.push_back(to);
  }
  for (std::size_t i = 0; i < n; ++i) result.offset[i + 1] += result.offset[i];
}

template <class Triangulation>
RegularTriangulation extract(const SeedsView& seeds) {
  const Triangulation t = triangulate<Triangulation>(seeds);
  RegularTriangulation result;
  result.hidden.assign(seeds.size(), 1);
  for (auto v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v) result.hidden[v->info()] = 0;
  fill_rows(result, finite_edges(t), seeds.size());
  result.simplices = finite_simplices(t);
  return result;
}

}  // namespace

RegularTriangulation regular_triangulation(const SeedsView& seeds) {
  return seeds.dimension == 2 ? extract<Triangulation2>(seeds) : extract<Triangulation3>(seeds);
}

}  // namespace powercell::test
