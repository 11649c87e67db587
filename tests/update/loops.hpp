/// \file
/// Random loops: a diagram that gets new weights and places again and again, beside fresh ones.
#pragma once

#include <cstdint>
#include <string>

namespace powercell::test {

struct LoopTally {
  std::size_t updates = 0;    ///< compared with fresh diagrams
  std::size_t from_mesh = 0;  ///< of these, those computed from the kept mesh
  std::size_t different = 0;  ///< with another status, neighbour, or measure
  std::uint64_t cells = 0, reused = 0;
  double worst_measure = 0;  ///< difference of a mass or a moment, in means
  double worst_wall = 0;     ///< the same of a wall
  std::string differences;   ///< the first few
};

/// A loop of a few updates, of seeds, domain and steps that follow from `random_seed`.
void run_loop(std::uint64_t random_seed, std::size_t most_seeds, LoopTally& tally);

}  // namespace powercell::test
