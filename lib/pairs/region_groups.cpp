#include "lib/pairs/region_groups.hpp"

#include <algorithm>
#include <limits>

#include "lib/pairs/region_order.hpp"
#include "lib/seeds/threads.hpp"

namespace powercell::pairs {
namespace {

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

RegionGroups::RegionGroups(const RegionMesh& mesh, int threads) : order(region_order(mesh, fan, threads)) {
  const auto d = static_cast<std::size_t>(mesh.dimension);
  level.push_back(boxes_of_regions(mesh, order, threads));
  while (level.back().low.size() > d) level.push_back(boxes_of_groups(level.back(), d));
}

}  // namespace powercell::pairs
