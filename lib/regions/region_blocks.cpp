#include "lib/regions/region_blocks.hpp"

#include <algorithm>
#include <limits>

#include "lib/base/compiler.hpp"
#include "lib/base/vector_copies.hpp"

namespace powercell {
namespace {

constexpr std::size_t fan = RegionGroups::fan;

std::vector<Lanes> blocks_of(const RegionGroups::Boxes& boxes, std::size_t d) {
  const std::size_t members = boxes.low.size() / d, blocks = (members + fan - 1) / fan;
  std::vector<Lanes> to(blocks * 2 * d);
  for (std::size_t block = 0; block < blocks; ++block)
    for (std::size_t lane = 0; lane < fan; ++lane) {
      const std::size_t member = std::min(block * fan + lane, members - 1);
      for (std::size_t k = 0; k < d; ++k) {
        to[block * 2 * d + k][lane] = boxes.low[member * d + k];
        to[block * 2 * d + d + k][lane] = boxes.high[member * d + k];
      }
    }
  return to;
}

template <int D>
POWERCELL_ALWAYS_INLINE void gaps_to(const Lanes* box, const double* origin, const double* low,
                                     const double* high, Lanes& gap) {
  using namespace lanes;
  Vector most = Vector{} - std::numeric_limits<double>::infinity();
  for (int k = 0; k < D; ++k) {
    Vector a, b;
    load(&box[k], a);
    load(&box[D + k], b);
    a = (a - origin[k]) - high[k];
    b = low[k] - (b - origin[k]);
    most = a > most ? a : most;
    most = b > most ? b : most;
  }
  store(most, &gap);
}

POWERCELL_VECTOR_COPIES void gaps_in(int dimension, const Lanes* box, const double* origin, const double* low,
                                     const double* high, Lanes& gap) {
  dimension == 2 ? gaps_to<2>(box, origin, low, high, gap) : gaps_to<3>(box, origin, low, high, gap);
}

}  // namespace

void RegionBlocks::find_gaps(std::size_t level, std::size_t block, const double* origin, const double* low,
                             const double* high, Lanes& gap) const {
  gaps_in(dimension, boxes(level, block), origin, low, high, gap);
}

RegionBlocks::RegionBlocks(const RegionMesh& mesh, const RegionGroups& groups) : dimension(mesh.dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  for (const RegionGroups::Boxes& boxes : groups.level) box.push_back(blocks_of(boxes, d));
  const std::size_t regions = groups.order.size();
  corner_offset.push_back(0);
  for (std::size_t first = 0; first < regions; first += fan) {
    const auto region_at = [&](std::size_t lane) {
      return groups.order[std::min(first + lane, regions - 1)];
    };
    std::uint32_t corners = 0;
    for (std::size_t lane = 0; lane < fan; ++lane)
      corners =
          std::max(corners, mesh.region_offset[region_at(lane) + 1] - mesh.region_offset[region_at(lane)]);
    for (std::uint32_t c = 0; c < corners; ++c)
      for (std::size_t k = 0; k < d; ++k) {
        Lanes& lanes = corner.emplace_back();
        for (std::size_t lane = 0; lane < fan; ++lane) {
          const std::uint32_t region = region_at(lane);
          const std::uint32_t slot =
              std::min(mesh.region_offset[region] + c, mesh.region_offset[region + 1] - 1);
          lanes[lane] = mesh.vertices[std::size_t{mesh.region_vertex[slot]} * d + k];
        }
      }
    corner_offset.push_back(corner.size());
  }
}

}  // namespace powercell
