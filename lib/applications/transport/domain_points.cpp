#include "lib/applications/transport/domain_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <powercell/regions.hpp>

namespace powercell {
namespace {

using Place = Eigen::Vector3d;

Place place(std::span<const double> positions, std::size_t i, std::size_t d) {
  Place p = Place::Zero();
  for (std::size_t c = 0; c < d; ++c) p[static_cast<Eigen::Index>(c)] = positions[i * d + c];
  return p;
}

struct Simplex {
  std::array<Place, 4> corner;
  int corners;

  double measure() const {
    const Place n = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    return corners == 3 ? n.norm() / 2 : std::abs(n.dot(corner[3] - corner[0])) / 6;
  }
  /// Calls add with the middles of a grid of simplices with `fine` divisions of each edge.
  template <class Add>
  void grid(int fine, const Add& add) const {
    const double shift = 1.0 / corners;
    for (int a = 0; a < fine; ++a)
      for (int b = 0; a + b < fine; ++b)
        for (int c = 0; corners == 3 ? c == 0 : a + b + c < fine; ++c) {
          const double u = (a + shift) / fine, v = (b + shift) / fine,
                       w = corners == 3 ? 0 : (c + shift) / fine;
          add(corner[0] * (1 - u - v - w) + corner[1] * u + corner[2] * v + corner[3] * w);
        }
  }
};

/// Convex polygons as fans of triangles, tetrahedra as they are.
std::vector<Simplex> simplices_of(const RegionsView& view, std::uint32_t region) {
  const auto d = static_cast<std::size_t>(view.dimension);
  const std::uint32_t first = view.region_offset[region], end = view.region_offset[region + 1];
  const auto corner = [&](std::uint32_t k) { return place(view.vertices, view.region_vertex[first + k], d); };
  if (view.shape == RegionShape::tetrahedron) return {{{corner(0), corner(1), corner(2), corner(3)}, 4}};
  std::vector<Simplex> fan;
  for (std::uint32_t k = 2; first + k < end; ++k)
    fan.push_back({{corner(0), corner(k - 1), corner(k), Place::Zero()}, 3});
  return fan;
}

/// Points of a grid over a box of space.
void add_grid(const Domain& domain, std::size_t count, Weighted& points) {
  const std::array<double, 3> low = domain.low(), high = domain.high();
  const double edge = std::cbrt(domain.measure() / static_cast<double>(count));
  std::array<std::size_t, 3> fine{};
  for (std::size_t c = 0; c < 3; ++c)
    fine[c] = static_cast<std::size_t>(
        std::clamp(std::round((high[c] - low[c]) / edge), 1.0, static_cast<double>(count)));
  const std::size_t size = fine[0] * fine[1] * fine[2];
  for (std::size_t k = 0; k < size; ++k) {
    const std::array<std::size_t, 3> at{k % fine[0], k / fine[0] % fine[1], k / fine[0] / fine[1]};
    for (std::size_t c = 0; c < 3; ++c)
      points.positions.push_back(low[c] + (static_cast<double>(at[c]) + 0.5) / static_cast<double>(fine[c]) *
                                              (high[c] - low[c]));
  }
  points.mass.assign(size, domain.measure() / static_cast<double>(size));
  points.weights.assign(size, 0);
}

}  // namespace

DomainPoints domain_points(const Domain& domain, std::size_t count) {
  const RegionsView view = domain.regions();
  const auto d = static_cast<std::size_t>(view.dimension);
  DomainPoints result;
  Weighted& points = result.points;
  if (domain.is_solid()) {
    for (const RegionPoint& at : random_points(domain, count, 1)) {
      points.positions.insert(points.positions.end(), at.point.begin(), at.point.end());
      result.region.push_back(0);
    }
    points.mass.assign(count, domain.measure() / static_cast<double>(count));
    points.weights.assign(count, 0);
    return result;
  }
  if (view.shape == RegionShape::box) {
    add_grid(domain, count, points);
    result.region.assign(points.size(), 0);
    return result;
  }
  for (std::uint32_t r = 0; r < view.size(); ++r)
    for (const Simplex& simplex : simplices_of(view, r)) {
      const double measure = simplex.measure();
      if (!(measure > 0)) continue;
      // A grid with f divisions has about f²/2 or f³/6 points.
      const double wanted = measure / domain.measure() * static_cast<double>(count);
      const int fine =
          std::max(1, static_cast<int>(
                          std::lround(simplex.corners == 3 ? std::sqrt(2 * wanted) : std::cbrt(6 * wanted))));
      const std::size_t first = points.size();
      simplex.grid(fine, [&](const Place& x) {
        points.positions.insert(points.positions.end(), x.data(), x.data() + d);
        points.mass.push_back(1);
        result.region.push_back(r);
      });
      for (std::size_t k = first; k < points.size(); ++k)
        points.mass[k] = measure / static_cast<double>(points.size() - first);
    }
  points.weights.assign(points.size(), 0);
  return result;
}

}  // namespace powercell
