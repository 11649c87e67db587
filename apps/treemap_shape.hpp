/// \file
/// The argument of treemap --shape.
#pragma once

#include <powercell/domain.hpp>
#include <string>

namespace powercell::app {

/// \param spec  W:H, circle[:N], hexagon, or a file that holds one polygon without holes
/// \throw Error invalid_argument, invalid_file, invalid_domain; treemap() checks convexity
Ring treemap_shape(const std::string& spec);

}  // namespace powercell::app
