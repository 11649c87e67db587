#include "tests/support/cgal_periodic.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Periodic_2_Delaunay_triangulation_2.h>
#include <CGAL/Periodic_2_Delaunay_triangulation_traits_2.h>
#include <CGAL/Periodic_3_regular_triangulation_3.h>
#include <CGAL/Periodic_3_regular_triangulation_traits_3.h>

#include <map>

namespace powercell::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Plane =
    CGAL::Periodic_2_Delaunay_triangulation_2<CGAL::Periodic_2_Delaunay_triangulation_traits_2<Kernel>>;
using Space =
    CGAL::Periodic_3_regular_triangulation_3<CGAL::Periodic_3_regular_triangulation_traits_3<Kernel>>;
using Simplices = std::vector<std::vector<PeriodicCorner>>;

Simplices in_plane(const SeedArray& seeds) {
  std::map<Plane::Point, std::uint32_t> index;
  for (std::uint32_t i = 0; i < seeds.size(); ++i)
    index[{seeds.coordinate(i, 0), seeds.coordinate(i, 1)}] = i;
  Plane triangulation(CGAL::Iso_rectangle_2<Kernel>(0, 0, 1, 1));
  for (const auto& [point, i] : index) triangulation.insert(point);
  Simplices simplices;
  for (auto t = triangulation.periodic_triangles_begin(Plane::UNIQUE);
       t != triangulation.periodic_triangles_end(Plane::UNIQUE); ++t) {
    std::vector<PeriodicCorner> corners;
    for (const auto& [point, offset] : *t) corners.push_back({index.at(point), {offset.x(), offset.y(), 0}});
    simplices.push_back(std::move(corners));
  }
  return simplices;
}

Simplices in_space(const SeedArray& seeds) {
  std::map<Space::Bare_point, std::uint32_t> index;
  std::vector<Space::Weighted_point> points;
  for (std::uint32_t i = 0; i < seeds.size(); ++i) {
    const Space::Bare_point point(seeds.coordinate(i, 0), seeds.coordinate(i, 1), seeds.coordinate(i, 2));
    index[point] = i;
    points.emplace_back(point, seeds.weights[i]);
  }
  const Space triangulation(points.begin(), points.end(), CGAL::Iso_cuboid_3<Kernel>(0, 0, 0, 1, 1, 1));
  Simplices simplices;
  for (auto t = triangulation.periodic_tetrahedra_begin(Space::UNIQUE);
       t != triangulation.periodic_tetrahedra_end(Space::UNIQUE); ++t) {
    std::vector<PeriodicCorner> corners;
    for (const auto& [point, offset] : *t)
      corners.push_back({index.at(point.point()), {offset.x(), offset.y(), offset.z()}});
    simplices.push_back(std::move(corners));
  }
  return simplices;
}

}  // namespace

Simplices cgal_periodic_simplices(const SeedArray& seeds) {
  return seeds.dimension == 2 ? in_plane(seeds) : in_space(seeds);
}

}  // namespace powercell::test
