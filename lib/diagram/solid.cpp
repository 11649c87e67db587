#include "lib/diagram/solid.hpp"

#include <algorithm>
#include <limits>

#include "lib/solid/sides.hpp"

namespace powercell {
namespace {

/// The seed of least power at the low corner of the container: its cell reaches outside.
std::uint32_t outermost_rank(const RegionMesh& domain, const SeedSet& seeds) {
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t rank = 0; rank < seeds.size(); ++rank) {
    double power = -seeds.weights[rank];
    for (std::size_t k = 0; k < 3; ++k) {
      const double corner = domain.low[k] - (domain.high[k] - domain.low[k]) / 16,
                   y = corner - seeds.positions[3 * std::size_t{rank} + k];
      power += y * y;
    }
    if (power < least) {
      least = power;
      best = rank;
    }
  }
  return best;
}

[[noreturn]] void refuse_contradiction(const SeedSet& seeds, std::uint32_t rank) {
  throw Error(ErrorCode::internal, "the cell of seed " + std::to_string(seeds.input[rank]) +
                                       " contradicts itself about which of its vertices lie in the solid; "
                                       "please report the input");
}

void add_part(std::uint32_t rank, const solid::SolidPart& part, MomentSums& measures, WallCollector& walls) {
  measures.set(rank, part.moments);
  walls.set_row(rank, part.neighbors, part.areas);
}

}  // namespace

SolidSides add_solid_cells(const DiagramSetup& setup, const ActiveSeeds& active, const ClipPlan& plan,
                           MomentSums& measures, WallCollector& walls) {
  const SolidCells& solid = *plan.solid;
  const SeedSet& seeds = active.seeds();
  if (setup.domain.is_solid() && !solid.unclear.empty()) refuse_contradiction(seeds, solid.unclear.front());
  const std::size_t container = setup.domain.region_count();
  for (const SolidCells::Cell& cell : solid.cells) add_part(cell.rank, cell.part, measures, walls);

  std::vector<bool> one_sided(seeds.size());
  std::vector<std::uint32_t> whole;
  for (std::uint32_t rank = 0; rank < seeds.size(); ++rank) {
    const std::uint64_t pair = plan.pairs.offset[rank];
    if (pair == plan.pairs.offset[rank + 1] || plan.pairs.region[pair] != container) continue;
    if (measures.status()[seeds.input[rank]] != SeedStatus::ok) continue;
    one_sided[rank] = true;
    whole.push_back(rank);
  }
  std::vector<std::uint32_t> outer{outermost_rank(setup.domain.mesh(), seeds)};
  for (const SolidCells::UniformCell& cell : solid.uniform) {
    one_sided[cell.rank] = true;
    if (cell.reaches_out) outer.push_back(cell.rank);
  }
  const auto neighbors = [&](std::uint32_t rank) {
    const auto found =
        std::lower_bound(solid.uniform.begin(), solid.uniform.end(), rank,
                         [](const SolidCells::UniformCell& cell, std::uint32_t r) { return cell.rank < r; });
    const bool is_uniform = found != solid.uniform.end() && found->rank == rank;
    return is_uniform ? std::span(found->neighbors) : walls.neighbors(rank);
  };
  const std::vector<solid::Side> side = find_sides({one_sided, solid.hints, neighbors, outer});

  SolidSides sides;
  for (const SolidCells::Cell& cell : solid.cells) sides.geometry.push_back({cell.rank, &cell.faces});
  for (const std::uint32_t rank : whole) {
    if (side[rank] == solid::Side::outside) sides.outside.push_back(rank);
    if (side[rank] == solid::Side::unknown) {
      sides.unclear.push_back(rank);
    }
  }
  for (const SolidCells::UniformCell& cell : solid.uniform) {
    if (side[cell.rank] == solid::Side::unknown) {
      sides.unclear.push_back(cell.rank);
      continue;
    }
    const bool inside = side[cell.rank] == solid::Side::inside;
    const solid::SolidPart& part = cell.part[inside];
    if (setup.domain.is_solid() ? part.flat : part.thin) {
      (setup.domain.is_solid() ? sides.flat : sides.unclear).push_back(cell.rank);
      continue;
    }
    add_part(cell.rank, part, measures, walls);
    sides.geometry.push_back({cell.rank, &cell.faces[inside]});
  }
  for (const auto& [rank, neighbor, triangle, area] : solid.coincidences) {
    walls.subtract(rank, neighbor, area);
    walls.subtract(neighbor, rank, area);
  }
  sides.flat.insert(sides.flat.end(), solid.flat.begin(), solid.flat.end());
  if (setup.domain.is_solid() && !sides.unclear.empty()) refuse_contradiction(seeds, sides.unclear.front());
  return sides;
}

}  // namespace powercell
