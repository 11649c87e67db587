/// \file
/// What the tool says of seeds that miss the domain, and the options that would bring them in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/io/tables/read_seeds.hpp"
#include "apps/io/tables/seeds_outside.hpp"

namespace powercell::app {

/// Seeds that miss the box.
struct Miss {
  bool refused = false;  ///< there are so many that it is hardly meant
  std::string message;   ///< how many, the columns they were taken from, and which to try instead
};

/// Whether fewer than one seed in twenty lies in the box.
/// \param positions  in the coordinates of the box
/// \param table  the seeds as they were read, in other coordinates if `transformed`
std::optional<Miss> find_miss(const io::SeedBox& box, const std::vector<double>& positions,
                              const io::SeedTable& table, bool transformed);

/// Of seeds that are not in memory together.
/// \throw Error invalid_seed if fewer than one in twenty is in the box
void require_inside(std::uint64_t outside, std::uint64_t seeds);

}  // namespace powercell::app
