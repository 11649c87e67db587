#include "lib/cell/tie_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lib/base/vectors.hpp"
#include "lib/cell/host_plane.hpp"

namespace powercell {
namespace {

/// The line or plane through all corners of a simplex but one, seen from a corner of it.
class OppositeFacet {
 public:
  /// \param corners  relative to the first one; the second (and third) follow
  explicit OppositeFacet(const std::array<Point, 3>& corners, std::size_t dimension) : origin_(corners[0]) {
    const Point a = corners[1] - corners[0];
    if (dimension == 2) {
      normal_ = {-a[1], a[0], 0};
      size_ = sum_of_sizes(a);
      return;
    }
    const Point b = corners[2] - corners[0];
    normal_ = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    size_ = sum_of_sizes(a) * sum_of_sizes(b);
  }

  /// In proportion to the distance, with its sign; 0 where rounding leaves that open.
  double height(const Point& x) const {
    const Point y = x - origin_;
    const double value = dot(normal_, y),
                 error = 16 * rounding_unit * size_ * sum_of_sizes(y) + least_product;
    return std::fabs(value) > error ? value : 0;
  }

 private:
  Point origin_, normal_{};
  double size_ = 0;
};

}  // namespace

void TieSets::learn(std::vector<std::uint32_t> ranks) {
  if (ranks.size() < least) return;
  Set set{std::move(ranks), std::vector<bool>(scene_.points.size())};
  for (const std::uint32_t rank : set.ranks) set.has[rank] = true;
  std::iter_swap(set.ranks.begin(),
                 std::min_element(set.ranks.begin(), set.ranks.end(), [&](std::uint32_t a, std::uint32_t b) {
                   return scene_.breaks_ties_before(static_cast<std::int32_t>(a),
                                                    static_cast<std::int32_t>(b));
                 }));
  if (sets_.size() == most) sets_.erase(sets_.begin());
  sets_.push_back(std::move(set));
}

const std::vector<std::uint32_t>* TieSets::find(std::span<const std::uint32_t> corners) const {
  for (const Set& set : sets_)
    if (std::all_of(corners.begin(), corners.end(), [&](std::uint32_t rank) { return set.has[rank]; }))
      return &set.ranks;
  return nullptr;
}

std::optional<std::uint32_t> TieSets::taker(const std::vector<std::uint32_t>& set,
                                            std::span<const std::uint32_t> corners, const ExactVertex& vertex,
                                            ExactCell& exact) const {
  const std::uint32_t first = set.front();
  const auto found = std::find(corners.begin(), corners.end(), first);
  if (found == corners.end()) return first;
  const auto place = [&](std::uint32_t rank) { return position(scene_.points[rank]); };
  std::array<Point, 3> others{};
  std::size_t count = 0;
  for (const std::uint32_t corner : corners)
    if (corner != first) others[count++] = place(corner);
  const OppositeFacet facet(others, corners.size() - 1);
  const double own = facet.height(place(first)), sign = own > 0 ? 1 : own < 0 ? -1 : 0;
  std::vector<std::uint32_t> open;
  std::optional<std::uint32_t> farthest;
  double lowest = 0;
  for (const std::uint32_t rank : set) {
    const double height = sign * facet.height(place(rank));
    if (height < lowest) {
      lowest = height;
      farthest = rank;
    }
    if (height == 0 && !farthest) open.push_back(rank);
  }
  if (farthest) return farthest;
  const auto taker = std::find_if(open.begin(), open.end(), [&](std::uint32_t rank) {
    return std::find(corners.begin(), corners.end(), rank) == corners.end() &&
           exact.is_outside(vertex, static_cast<std::int32_t>(rank));
  });
  return taker == open.end() ? std::nullopt : std::optional(*taker);
}

}  // namespace powercell
