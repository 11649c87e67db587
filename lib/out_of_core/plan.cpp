#include "lib/out_of_core/plan.hpp"

#include <algorithm>
#include <powercell/error.hpp>
#include <string>

namespace powercell::out_of_core {
namespace {

/// Bytes of each seed of a piece in the plane and in space, a third more than was measured of 10^5 to 10^6
/// seeds (docs/scale.md): in a domain of one region, and of many. Images of a periodic domain take up to half
/// as much again.
constexpr std::uint64_t bytes_of_piece_seed[2][2] = {{850, 1500}, {1700, 3500}};
/// What it has less where walls are only counted.
constexpr std::uint64_t bytes_of_walls[2] = {80, 300};
/// Of programs of the device and buffers that do not depend on the number of seeds.
constexpr std::uint64_t bytes_of_programs = std::uint64_t{256} << 20;
/// Smaller pieces would spend more time on their boundaries than on themselves.
constexpr std::uint64_t least_piece = 16384, usual_piece = std::uint64_t{1} << 22;

std::string in_mebibytes(std::uint64_t bytes) {
  return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB";
}

}  // namespace

std::uint64_t seeds_of_piece(std::uint64_t seeds, const Domain& domain, std::uint64_t memory, bool walls,
                             std::uint64_t most) {
  // A leaf of the tree of all seeds has eight seeds, its levels above it a seventh of its nodes; and a seed
  // has its status, and whether a piece has it.
  const auto d = static_cast<std::uint64_t>(domain.dimension());
  const std::uint64_t tree = seeds * (2 * d + 1) * sizeof(double) / 7, all = tree + 2 * seeds,
                      fixed = bytes_of_programs + all,
                      in_bounds = bytes_of_piece_seed[domain.region_count() > 1 ? 1 : 0][d - 2] -
                                  (walls ? 0 : bytes_of_walls[d - 2]),
                      of_seed = domain.is_periodic() ? in_bounds + in_bounds / 2 : in_bounds;
  const std::uint64_t least = fixed + std::min(seeds, least_piece) * of_seed;
  if (memory < least)
    throw Error(ErrorCode::invalid_argument, in_mebibytes(memory) + " of memory are too little for " +
                                                 std::to_string(seeds) + " seeds out of core; the least is " +
                                                 in_mebibytes(least));
  return std::clamp((memory - fixed) / of_seed, std::uint64_t{1}, most == 0 ? usual_piece : most);
}

}  // namespace powercell::out_of_core
