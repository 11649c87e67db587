#include "lib/applications/remeshing/seed_grid.hpp"

#include <algorithm>

namespace powercell::remeshing {

void SeedGrid::insert(std::uint32_t id, Vec at, double size, double weight) {
  const int exponent = std::ilogb(size);
  Level& level = levels_[exponent];
  if (level.side == 0) {
    level.side = std::ldexp(4.0, exponent);
    level.most_weight = weight;
  }
  level.most_weight = std::max(level.most_weight, weight);
  level.cube[level.key(at)].push_back(id);
  ++level.count;
}

void SeedGrid::remove(std::uint32_t id, Vec at, double size) {
  Level& level = levels_.at(std::ilogb(size));
  const auto cube = level.cube.find(level.key(at));
  std::erase(cube->second, id);
  if (cube->second.empty()) level.cube.erase(cube);
  --level.count;
}

}  // namespace powercell::remeshing
