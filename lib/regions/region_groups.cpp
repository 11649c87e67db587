#include "lib/regions/region_groups.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "lib/base/threads.hpp"

namespace powercell {
namespace {

/// The least number of regions for which a parallel task pays.
constexpr std::size_t least_shared = 4096;

std::vector<double> centroids_of(const RegionMesh& mesh, int threads) {
  const auto d = static_cast<std::size_t>(mesh.dimension);
  std::vector<double> centroids(mesh.region_count() * d);
  parallel_for(threads, mesh.region_count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const std::uint32_t first = mesh.region_offset[r], last = mesh.region_offset[r + 1];
      for (std::uint32_t slot = first; slot < last; ++slot)
        for (std::size_t k = 0; k < d; ++k)
          centroids[r * d + k] +=
              mesh.vertices[std::size_t{mesh.region_vertex[slot]} * d + k] / (last - first);
    }
  });
  return centroids;
}

struct Range {
  std::size_t first, last, width;  // [first, last), to be divided into groups of `width` regions
};

class Halving {
 public:
  Halving(const std::vector<double>& centroids, std::size_t d, std::size_t fan,
          std::vector<std::uint32_t>& order)
      : x_(centroids), d_(d), fan_(fan), order_(order) {}

  /// Halves the range recursively down to at most `least` regions; appends those ranges to `rest`.
  void run(Range range, std::size_t least, std::vector<Range>& rest) {
    if (range.last - range.first <= least) return rest.push_back(range);
    while (range.last - range.first <= range.width) range.width /= fan_;
    const std::size_t groups = (range.last - range.first + range.width - 1) / range.width;
    const std::size_t middle = range.first + groups / 2 * range.width;
    const std::size_t axis = longest_axis(range);
    const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(range.first), at(middle), at(range.last), [&](std::uint32_t a, std::uint32_t b) {
      const double xa = x_[a * d_ + axis], xb = x_[b * d_ + axis];
      return xa != xb ? xa < xb : a < b;
    });
    run({range.first, middle, range.width}, least, rest);
    run({middle, range.last, range.width}, least, rest);
  }

 private:
  std::size_t longest_axis(const Range& range) const {
    std::size_t axis = 0;
    double longest = -1;
    for (std::size_t k = 0; k < d_; ++k) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t at = range.first; at < range.last; ++at) {
        low = std::min(low, x_[order_[at] * d_ + k]);
        high = std::max(high, x_[order_[at] * d_ + k]);
      }
      if (high - low > longest) longest = high - low, axis = k;
    }
    return axis;
  }

  const std::vector<double>& x_;
  std::size_t d_, fan_;
  std::vector<std::uint32_t>& order_;
};

/// The regions in an order in which each `fan`^l consecutive ones, counted from the first, lie close
/// together. Ranges are halved across their longest axis, at a multiple of the largest group smaller than the
/// range. Does not depend on `threads`.
std::vector<std::uint32_t> compact_order(const RegionMesh& mesh, std::size_t fan, int threads) {
  const std::size_t count = mesh.region_count();
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  const std::vector<double> centroids = centroids_of(mesh, threads);
  Halving halving(centroids, static_cast<std::size_t>(mesh.dimension), fan, order);
  std::size_t width = 1;
  while (width < count) width *= fan;
  std::vector<Range> shares;
  halving.run({0, count, width}, std::max(least_shared, count / 64), shares);
  parallel_tasks(threads, shares.size(), [&](int, std::size_t share) {
    std::vector<Range> groups;
    halving.run(shares[share], fan, groups);
  });
  return order;
}

RegionGroups::Boxes no_boxes(std::size_t count) {
  return {std::vector<double>(count, std::numeric_limits<double>::infinity()),
          std::vector<double>(count, -std::numeric_limits<double>::infinity())};
}

RegionGroups::Boxes boxes_of_regions(const RegionMesh& mesh, const std::vector<std::uint32_t>& order,
                                     int threads) {
  const auto d = static_cast<std::size_t>(mesh.dimension);
  RegionGroups::Boxes boxes = no_boxes(order.size() * d);
  parallel_for(threads, order.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      for (std::uint32_t s = mesh.region_offset[order[k]]; s < mesh.region_offset[order[k] + 1]; ++s)
        for (std::size_t axis = 0; axis < d; ++axis) {
          const double x = mesh.vertices[std::size_t{mesh.region_vertex[s]} * d + axis];
          boxes.low[k * d + axis] = std::min(boxes.low[k * d + axis], x);
          boxes.high[k * d + axis] = std::max(boxes.high[k * d + axis], x);
        }
  });
  return boxes;
}

RegionGroups::Boxes boxes_of_groups(const RegionGroups::Boxes& below, std::size_t d) {
  const std::size_t members = below.low.size() / d;
  RegionGroups::Boxes boxes = no_boxes((members + RegionGroups::fan - 1) / RegionGroups::fan * d);
  for (std::size_t k = 0; k < members; ++k)
    for (std::size_t axis = 0; axis < d; ++axis) {
      const std::size_t from = k * d + axis, to = k / RegionGroups::fan * d + axis;
      boxes.low[to] = std::min(boxes.low[to], below.low[from]);
      boxes.high[to] = std::max(boxes.high[to], below.high[from]);
    }
  return boxes;
}

}  // namespace

RegionGroups::RegionGroups(const RegionMesh& mesh, int threads) : order(compact_order(mesh, fan, threads)) {
  const auto d = static_cast<std::size_t>(mesh.dimension);
  level.push_back(boxes_of_regions(mesh, order, threads));
  while (level.back().low.size() > d) level.push_back(boxes_of_groups(level.back(), d));
}

}  // namespace powercell
