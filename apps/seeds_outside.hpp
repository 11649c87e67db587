/// \file
/// Seeds that miss the domain: latitudes taken for longitudes, numbers of rows taken for coordinates, metres
/// beside degrees.
#pragma once

#include <cstddef>
#include <powercell/domain.hpp>

#include "apps/io/read_seeds.hpp"

namespace powercell::app {

/// Number of seeds outside the domain's box; of a surface, whose seeds may lie off it, the box widened by
/// half its diagonal.
std::size_t count_outside(const Domain& domain, const io::SeedTable& seeds);

/// Refuses seeds of which fewer than one in twenty lies in that box.
/// \param name  of their file, for the message
/// \throw Error invalid_seed: how many, the columns they were taken from, and which to try instead
void require_inside(const Domain& domain, const io::SeedTable& seeds, std::size_t outside,
                    const std::string& name);

/// "12 of 3,000 seeds lie outside the domain's box".
std::string outside_line(std::size_t outside, std::size_t seeds);

}  // namespace powercell::app
