/// \file
/// Densities made of bytes.
#pragma once

#include <powercell/density.hpp>

#include "tests/fuzz/input.hpp"

namespace powercell::fuzz {

/// Any density, good or not: constants, formulas (some of any characters), small images, values at vertices.
/// \throw Error where the library refuses
Density any_density(Input& input, const Domain& domain);

}  // namespace powercell::fuzz
