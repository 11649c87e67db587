#include "lib/applications/sampling/near_sides.hpp"

#include "lib/applications/sampling/nearest.hpp"

namespace powercell {
namespace {

using Vec = Vector3<double>;

// A side is opposite if it is within 60° of the normal: not where the surface continues beyond a gap or at an
// edge whose triangles do not share corners.
constexpr double least_cosine = 0.5;
// Of the radius. The rim of a plate is connected with both sides, and is to go with one of them.
constexpr double own_share = 0.5;

}  // namespace

NearSidesSearch::NearSidesSearch(const Domain& surface)
    : mesh_(surface.regions()), last_seen_(mesh_.size(), 0) {
  std::vector<Box> boxes(mesh_.size());
  for (std::uint32_t r = 0; r < mesh_.size(); ++r)
    for (const Vec& x : triangle(r)) boxes[r].add(x.data());
  boxes_ = std::make_shared<const BoxTree>(boxes);
}

Vec NearSidesSearch::corner(std::uint32_t region, std::uint32_t k) const {
  const double* x = &mesh_.vertices[3 * std::size_t{mesh_.region_vertex[mesh_.region_offset[region] + k]}];
  return {x[0], x[1], x[2]};
}

std::array<Vec, 3> NearSidesSearch::triangle(std::uint32_t region) const {
  return {corner(region, 0), corner(region, 1), corner(region, 2)};
}

/// The regions that are connected with the point's across edges that meet the ball.
std::vector<std::uint32_t> NearSidesSearch::connected(const RegionPoint& point, double radius) {
  ++search_;
  std::vector<std::uint32_t> found{point.region};
  last_seen_[point.region] = search_;
  for (std::size_t k = 0; k < found.size(); ++k)
    for (std::uint32_t e = 0; e < 3; ++e) {
      const Border& border = mesh_.facet[mesh_.facet_offset[found[k]] + e];
      if (border.kind != Border::Kind::interior || last_seen_[border.index] == search_) continue;
      const std::array<Vec, 2> edge{corner(found[k], e), corner(found[k], (e + 1) % 3)};
      if (norm(nearest_in_polygon(edge, point.point) - point.point) > radius) continue;
      last_seen_[border.index] = search_;
      found.push_back(border.index);
    }
  return found;
}

NearSides NearSidesSearch::around(const RegionPoint& point, double radius) {
  NearSides sides{connected(point, radius), {}};
  const std::array<Vec, 3> own = triangle(point.region);
  Vec normal = cross(own[1] - own[0], own[2] - own[0]);
  normal = (1 / norm(normal)) * normal;
  Box ball;
  for (const double side : {-radius, radius}) {
    const Vec x = point.point + Vec{side, side, side};
    ball.add(x.data());
  }
  boxes_->for_each_meeting(ball, [&](std::uint32_t r) {
    if (last_seen_[r] == search_) return;
    const Vec way = nearest_in_polygon(triangle(r), point.point) - point.point;
    const double distance = norm(way);
    if (distance <= radius && std::abs(dot(way, normal)) >= least_cosine * distance)
      sides.opposite.push_back(r);
  });
  if (sides.opposite.empty()) {
    sides.own.clear();
    return sides;
  }
  std::erase_if(sides.own, [&](std::uint32_t r) {
    return norm(nearest_in_polygon(triangle(r), point.point) - point.point) > own_share * radius;
  });
  return sides;
}

}  // namespace powercell
