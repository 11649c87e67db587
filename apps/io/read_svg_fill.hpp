/// \file
/// What a set of closed outlines fills, by SVG's two rules.
#pragma once

#include <powercell/domain.hpp>
#include <string>
#include <vector>

namespace powercell::io {

/// The area that `rings` fill together, which may cross themselves and each other: where the winding
/// number is odd (even_odd) or not zero. \throw Error invalid_file
std::vector<PolygonPart> fill(const std::vector<Ring>& rings, bool even_odd, const std::string& name);

}  // namespace powercell::io
