// Shades of the groups on the second level of a treemap: those with a common border differ.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "apps/io/picture/periodic.hpp"
#include "apps/io/write/treemap.hpp"

namespace powercell::io {
namespace {

struct Corner {
  double x, y;
};

// The convex polygon of a node.
class GroupOutline {
 public:
  GroupOutline(const Treemap& map, std::size_t node) {
    for (std::uint64_t v = map.vertex_offset[node]; v < map.vertex_offset[node + 1]; ++v) {
      corners_.push_back({map.vertices[2 * v], map.vertices[2 * v + 1]});
      box_.add(&map.vertices[2 * v]);
    }
  }
  const FlatBox& box() const { return box_; }

  // Length of the border with another polygon, which lies outside of this one. \param slack  of coordinates
  double border(const GroupOutline& other, double slack) const {
    double sum = 0;
    for (std::size_t k = 0; k < corners_.size(); ++k)
      for (std::size_t m = 0; m < other.corners_.size(); ++m)
        sum += common(corners_[k], corners_[(k + 1) % corners_.size()], other.corners_[m],
                      other.corners_[(m + 1) % other.corners_.size()], slack);
    return sum;
  }

 private:
  // Of the edges a b and c d, as far as they lie on each other.
  static double common(Corner a, Corner b, Corner c, Corner d, double slack) {
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > slack)) return 0;
    const double ux = (b.x - a.x) / length, uy = (b.y - a.y) / length;
    const auto along = [&](Corner p) { return ux * (p.x - a.x) + uy * (p.y - a.y); };
    const auto across = [&](Corner p) { return std::fabs(uy * (p.x - a.x) - ux * (p.y - a.y)); };
    if (std::max(across(c), across(d)) > slack) return 0;
    const auto [low, high] = std::minmax({along(c), along(d)});
    return std::max(0.0, std::min(high, length) - std::max(low, 0.0));
  }

  std::vector<Corner> corners_;
  FlatBox box_;
};

struct GroupBorder {
  std::size_t neighbor;
  double length;
};

// The borders of the groups of a branch with each other, by a sweep along x.
std::vector<std::vector<GroupBorder>> borders_of(const Treemap& map, const std::vector<std::size_t>& groups) {
  std::vector<GroupOutline> outlines;
  double size = 0;
  for (const std::size_t node : groups) {
    outlines.emplace_back(map, node);
    for (std::size_t k = 0; k < 2; ++k)
      size =
          std::max({size, std::fabs(outlines.back().box().low[k]), std::fabs(outlines.back().box().high[k])});
  }
  const double slack = 1e-9 * size;
  std::vector<std::size_t> order(groups.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return outlines[a].box().low[0] < outlines[b].box().low[0];
  });
  std::vector<std::vector<GroupBorder>> borders(groups.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t m = k + 1; m < order.size(); ++m) {
      const std::size_t a = order[k], b = order[m];
      const FlatBox &one = outlines[a].box(), &other = outlines[b].box();
      if (other.low[0] > one.high[0] + slack) break;
      if (other.low[1] > one.high[1] + slack || one.low[1] > other.high[1] + slack) continue;
      const double length = outlines[a].border(outlines[b], slack);
      if (length <= 100 * slack) continue;
      borders[a].push_back({b, length});
      borders[b].push_back({a, length});
    }
  return borders;
}

// The group with the fewest remaining neighbours, of these the smallest, is removed first. Coloured in
// reverse order each has at most five coloured neighbours, as any map in the plane.
std::vector<std::size_t> smallest_last(const std::vector<std::vector<GroupBorder>>& borders,
                                       const std::vector<std::size_t>& by_value) {
  std::vector<std::size_t> degree, order, rest(by_value.rbegin(), by_value.rend());
  for (const std::vector<GroupBorder>& own : borders) degree.push_back(own.size());
  while (!rest.empty()) {
    const auto least = std::min_element(rest.begin(), rest.end(),
                                        [&](std::size_t a, std::size_t b) { return degree[a] < degree[b]; });
    order.push_back(*least);
    for (const GroupBorder& border : borders[*least]) --degree[border.neighbor];
    rest.erase(least);
  }
  std::reverse(order.begin(), order.end());
  return order;
}

// Groups keep earlier shades unless that of a larger neighbour is the same; the others get the shade with
// which they share the least border. Largest first.
void shade_branch(const Treemap& map, const std::vector<std::size_t>& groups,
                  std::span<const std::int64_t> earlier, std::vector<std::int64_t>& shade) {
  const std::vector<std::vector<GroupBorder>> borders = borders_of(map, groups);
  std::vector<std::size_t> order(groups.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return map.value[groups[a]] > map.value[groups[b]]; });
  const auto bordered = [&](std::size_t k) {
    std::array<double, group_shades> length{};
    for (const GroupBorder& border : borders[k])
      if (const std::int64_t other = shade[groups[border.neighbor]]; other >= 0)
        length[static_cast<std::size_t>(other)] += border.length;
    return length;
  };
  for (const std::size_t k : order) {
    const std::int64_t old = earlier.empty() ? -1 : earlier[groups[k]];
    if (old >= 0 && old < group_shades && bordered(k)[static_cast<std::size_t>(old)] == 0)
      shade[groups[k]] = old;
  }
  std::size_t turn = 0;
  for (const std::size_t k : smallest_last(borders, order)) {
    if (shade[groups[k]] >= 0) continue;
    const auto length = bordered(k);
    std::size_t best = turn % group_shades;  // beginning with another one each time spreads them
    for (std::size_t s = 0; s < group_shades; ++s)
      if (const std::size_t here = (turn + s) % group_shades; length[here] < length[best]) best = here;
    shade[groups[k]] = static_cast<std::int64_t>(best);
    turn = best + 1;
  }
}

}  // namespace

std::vector<std::int64_t> number_groups(const Treemap& map, std::span<const std::int64_t> parent,
                                        std::span<const std::int64_t> earlier) {
  const std::size_t n = map.kind.size();
  std::vector<std::int64_t> shade(n, -1);
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < n; ++i)
    if (map.depth[i] == 2 && map.kind[i] == TreeNode::group) groups.push_back(i);
  std::stable_sort(groups.begin(), groups.end(),
                   [&](std::size_t a, std::size_t b) { return parent[a] < parent[b]; });
  for (auto first = groups.begin(); first != groups.end();) {
    const auto end =
        std::find_if(first, groups.end(), [&](std::size_t i) { return parent[i] != parent[*first]; });
    shade_branch(map, {first, end}, earlier, shade);
    first = end;
  }
  return shade;
}

}  // namespace powercell::io
