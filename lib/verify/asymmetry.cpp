#include "lib/verify/asymmetry.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "lib/base/text.hpp"
#include "lib/verify/angles.hpp"

namespace powercell {
namespace {

/// Sine of the smallest angle of a triangle of seeds, which lies between its two longer sides.
long double least_sine(const Vector& a, const Vector& b, const Vector& c) {
  std::array<long double, 3> side{norm(b - a), norm(c - b), norm(a - c)};
  std::ranges::sort(side);
  return norm(cross(b - a, c - a)) / (side[1] * side[2]);
}

/// How far rounding may move the ends of the wall of two seeds, to first order: for each plane at which it
/// may end, the rounding of both planes over the sine of their angle.
class Ends {
 public:
  Ends(const Adjacency& adjacency, const RegionMesh* mesh, const Rounding& rounding)
      : mesh_(mesh),
        rounding_(rounding),
        i_(adjacency.asymmetric[0]),
        j_(adjacency.asymmetric[1]),
        normal_(rounding.position(j_) - rounding.position(i_)),
        moved_(rounding.wall_shift(i_, j_)) {
    std::ranges::set_intersection(row_of(adjacency, i_), row_of(adjacency, j_), std::back_inserter(common_));
  }

  long double sum() {
    if (!is_surface())
      for (const std::uint32_t k : common_) add(shift(k), sine(k));
    for (std::size_t r = 0; mesh_ != nullptr && r < mesh_->region_count(); ++r)
      if (const Corners corners = corners_of(*mesh_, r); is_met(corners, j_)) add_region(corners);
    return sum_;
  }

 private:
  bool is_surface() const { return mesh_ != nullptr && mesh_->kind == DomainKind::surface; }

  /// Whether the bisector of i and k has points on both sides, or on it up to rounding.
  bool is_met(const Corners& points, std::uint32_t k) const {
    const double slack = rounding_.wall_shift(i_, k);
    bool before = false, behind = false;
    for (const Vector& x : points) {
      const long double beyond = rounding_.beyond(i_, k, x);
      before |= beyond <= slack;
      behind |= beyond >= -slack;
    }
    return before && behind;
  }

  /// Rounding of the bisectors of both seeds with a third, at which the two sides of the wall end.
  double shift(std::uint32_t k) const { return rounding_.wall_shift(i_, k) + rounding_.wall_shift(j_, k); }
  long double sine(std::uint32_t k) const {
    return least_sine(rounding_.position(i_), rounding_.position(j_), rounding_.position(k));
  }

  void add_region(const Corners& corners) {
    for (const Corners& facet : facets_of(*mesh_, corners))
      if (is_met(facet, j_))
        add(rounding_.shift(i_) + rounding_.shift(j_), mesh_->cell_dimension == 2
                                                           ? sine_to_plane(facet[1] - facet[0], normal_)
                                                           : sine_between(normal_of(facet), normal_));
    if (!is_surface()) return;
    // Two bisectors meet in a line, which meets the triangle in a point.
    for (const std::uint32_t k : common_) {
      const Vector line = cross(normal_, rounding_.position(k) - rounding_.position(i_));
      if (is_met(corners, k)) add(shift(k), sine(k) * sine_to_plane(line, normal_of(corners)));
    }
  }

  void add(double moved, long double sine) { sum_ += (moved_ + moved) / sine; }

  const RegionMesh* mesh_;
  const Rounding& rounding_;
  std::uint32_t i_, j_;
  Vector normal_;
  double moved_;
  std::vector<std::uint32_t> common_;  // neighbours of both seeds
  long double sum_ = 0;
};

}  // namespace

double allowed_asymmetry(const Adjacency& adjacency, const RegionMesh* mesh, const Rounding& rounding) {
  constexpr double right_angles = 128;
  const double largest =
      adjacency.wall.empty() ? 0 : *std::max_element(adjacency.wall.begin(), adjacency.wall.end());
  const double rim = rounding.extent().rim_of(largest), rounded = rounding.unit() * rounding.diagonal() * rim;
  const auto within = [&](double allowed) {
    return std::max(right_angles * rounded, std::min(largest / 2, allowed));
  };
  const auto n = static_cast<double>(adjacency.offset.size() - 1);
  const double usual = within(rounded * (1000 + n));
  if (adjacency.asymmetry <= usual || adjacency.asymmetric[0] == adjacency.asymmetric[1]) return usual;
  if (!adjacency.shift.empty()) return usual;  // which images these are is not known
  const auto ends = static_cast<double>(Ends(adjacency, mesh, rounding).sum());
  return std::max(usual, within(rim * ends));
}

std::string text_of_asymmetry(const Adjacency& adjacency) {
  return "the two sides of the wall of seeds " + std::to_string(adjacency.asymmetric[0]) + " and " +
         std::to_string(adjacency.asymmetric[1]) + " differ by " + digits(adjacency.asymmetry, 3);
}

}  // namespace powercell
