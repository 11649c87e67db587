/// \file
/// The area filled by a set of closed outlines, by SVG's two rules.
#pragma once

#include <powercell/domain.hpp>
#include <string>
#include <vector>

namespace powercell::io {

/// The area where the winding number of all `rings` together is odd (even_odd) or not zero. Rings may cross
/// themselves and each other.
/// \throw Error invalid_file
std::vector<PolygonPart> fill(const std::vector<Ring>& rings, bool even_odd, const std::string& name);

}  // namespace powercell::io
