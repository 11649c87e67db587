/// \file
/// The argument of treemap --shape.
#pragma once

#include <powercell/domain.hpp>
#include <string>
#include <vector>

namespace powercell::app {

/// \param spec  W:H, circle[:N], hexagon, or a file that holds one polygon without holes
/// \throw Error invalid_argument, invalid_file, invalid_domain; treemap() checks convexity
/// \param notes  appended to: whether the hull stands for an outline that is concave by rounding only
Ring treemap_shape(const std::string& spec, std::vector<std::string>& notes);

}  // namespace powercell::app
